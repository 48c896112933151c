//! What the C library says comes through: answers, errors, panics, and every form of a mesh.
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::thread;
use tribox::{bricks, overlap, voxelize, Aabb, Accuracy, Brick, Error, Grid, Mesh, Voxels};

const SIDE: f64 = 3.3; // a cube from 0.2 to 3.5
const GRID: Grid = Grid { origin: [-1.0, -0.5, 0.0], cell: [0.25, 0.5, 0.125], size: [70, 9, 40] };

fn cube() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let corner = |n: u32| [0, 1, 2].map(|a| 0.2 + SIDE * f64::from(n >> a & 1));
    let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    ((0..8).map(corner).collect(), faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

fn exact(mesh: &Mesh, aabb: &Aabb) -> Vec<usize> {
    overlap(mesh, aabb, Accuracy::Exact).unwrap().iter().collect()
}

#[test]
fn voxels_are_overlaps() {
    let (positions, triangles) = cube();
    let mesh = Mesh::new(&positions, &triangles);
    let voxels = voxelize(&mesh, &GRID).unwrap();
    let mut cells = Vec::new();
    for k in 0..GRID.size[2] {
        for j in 0..GRID.size[1] {
            for i in 0..GRID.size[0] {
                let mask = overlap(&mesh, &GRID.cell_box([i, j, k]), Accuracy::Exact).unwrap();
                assert_eq!(voxels.get([i, j, k]), mask.overlapping() > 0);
                assert_eq!(mask.iter().collect::<Vec<_>>(), (0..12).filter(|&t| mask.get(t)).collect::<Vec<_>>());
                if mask.overlapping() > 0 {
                    cells.push([i, j, k]);
                }
            }
        }
    }
    assert_eq!((voxels.count(), voxels.iter().collect::<Vec<_>>()), (cells.len(), cells.clone()));
    assert!(!voxels.get([70, 0, 0]) && !voxels.get([0, 9, 0]) && !voxels.get([0, 0, u32::MAX]));

    let mut handed = Vec::new();
    assert_eq!(bricks(&mesh, &GRID, |brick: &Brick| handed.extend(brick.cells())), Ok(cells.len()));
    handed.sort_by_key(|&[i, j, k]| (k, j, i));
    assert_eq!(handed, cells);

    let mut parts = Voxels::new(&GRID).unwrap();
    let added: Vec<_> = triangles.chunks(5).map(|part| parts.add(&Mesh::new(&positions, part)).unwrap()).collect();
    assert_eq!((&parts, added.iter().sum::<usize>()), (&voxels, cells.len()));

    let solid = voxels.filled().unwrap();
    assert!(solid.get([9, 4, 16]) && !voxels.get([9, 4, 16]) && !solid.get([0, 0, 0]));
    assert_eq!((solid.count(), solid.filled().as_ref()), (solid.iter().count(), Ok(&solid)));
}

#[test]
fn forms_of_a_mesh() {
    let (positions, triangles) = cube();
    let floats: Vec<[f32; 3]> = positions.iter().map(|p| p.map(|u| u as f32)).collect();
    let wide: Vec<[f32; 5]> = floats.iter().map(|&[x, y, z]| [x, y, z, f32::NAN, -9.0]).collect();
    let turned: Vec<[f64; 3]> = positions.iter().map(|&[x, y, z]| [z, x, y]).collect();
    let short: Vec<[u16; 3]> = triangles.iter().map(|t| t.map(|n| n as u16)).collect();
    let soup: Vec<[f64; 3]> = triangles.iter().flatten().map(|&n| positions[n as usize]).collect();
    let aabb = Aabb { lo: [0.0, 0.1, 1.2], hi: [0.3, 0.4, 1.3] }; // at one edge, along z
    let expected = exact(&Mesh::new(&positions, &triangles), &aabb);
    assert!(!expected.is_empty() && expected.len() < 12);
    for mesh in [
        Mesh::new(&floats, &triangles),
        Mesh::new(&wide, &short),
        Mesh::new(&positions, &short),
        Mesh::unindexed(&soup),
        Mesh::new(&turned, &triangles).with_axes(231),
    ] {
        assert_eq!(exact(&mesh, &aabb), expected);
    }
    // 0.2f32 is greater than 0.2: the faces of floats miss a box that ends there.
    let touching = Aabb { lo: [0.0; 3], hi: [0.2; 3] };
    assert_eq!(exact(&Mesh::new(&positions, &triangles), &touching).len(), 6);
    assert!(exact(&Mesh::new(&floats, &triangles), &touching).is_empty());
    // A plane that misses the corner [1, 1, 1] by less than double can tell.
    let beyond = 3.0 + 2.0 * f64::EPSILON;
    let plane = [[beyond, 0.0, 0.0], [0.0, beyond, 0.0], [0.0, 0.0, beyond]];
    let below = Aabb { lo: [0.5; 3], hi: [1.0; 3] };
    assert!(exact(&Mesh::unindexed(&plane), &below).is_empty());
    assert_eq!(overlap(&Mesh::unindexed(&plane), &below, Accuracy::Conservative).unwrap().overlapping(), 1);
    assert!(catch_unwind(|| Mesh::new(&[[0f32; 0]; 9], &[[0u32; 3]])).is_err());
    assert!(catch_unwind(|| Mesh::unindexed(&[[0f64; 3]; 4])).is_err());
    assert!(exact(&Mesh::unindexed::<f32, 3>(&[]), &aabb).is_empty());
    let many = vec![[0.25f32, 0.25, 1.25]; 3 * 130];
    let mesh = Mesh::unindexed(&many);
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| assert_eq!(exact(&mesh, &aabb), (0..130).collect::<Vec<_>>()));
        }
    });
    assert_eq!(tribox::version(), env!("CARGO_PKG_VERSION"));
}

#[test]
fn errors() {
    let (positions, mut triangles) = cube();
    let aabb = Aabb { lo: [0.0; 3], hi: [1.0; 3] };
    let mesh = Mesh::new(&positions, &triangles);
    let says = |error: Error, text: &str| assert!(error.to_string().contains(text), "{error}");
    says(overlap(&mesh, &Aabb { hi: [0.0, f64::INFINITY, 0.0], ..aabb }, Accuracy::Fast).unwrap_err(), "box");
    says(overlap(&mesh.with_axes(112), &aabb, Accuracy::Exact).unwrap_err(), "argument");
    let fine = Grid { origin: [1e300; 3], ..GRID };
    assert_eq!((voxelize(&mesh, &fine), bricks(&mesh, &fine, |_| ())), (Err(Error::BadGrid), Err(Error::BadGrid)));
    for size in [[0, 9, 9], [1 << 31; 3], [u32::MAX; 3]] {
        says(voxelize(&mesh, &Grid { size, ..GRID }).unwrap_err(), "grid");
    }
    for size in [[0, 9, 9], [u32::MAX; 3]] {
        says(bricks(&mesh, &Grid { size, ..GRID }, |_| ()).unwrap_err(), "grid");
    }
    triangles[7][2] = 8;
    let mesh = Mesh::new(&positions, &triangles);
    says(overlap(&mesh, &aabb, Accuracy::Conservative).unwrap_err(), "vertex");
    let mut voxels = Voxels::new(&GRID).unwrap();
    assert_eq!((voxels.add(&mesh), voxels.count(), voxels.iter().next()), (Err(Error::BadVertex), 0, None));
    assert_eq!(bricks(&mesh, &GRID, |_| ()), Err(Error::BadVertex));
}

#[test]
fn panics_come_through() {
    let (positions, triangles) = cube();
    let mesh = Mesh::new(&positions, &triangles);
    let mut taken = 0;
    let panic = catch_unwind(AssertUnwindSafe(|| {
        bricks(&mesh, &GRID, |brick| {
            taken += 1;
            assert!(taken < 3, "brick {:?} is the third", brick.at);
        })
    }));
    let message = panic.unwrap_err();
    assert!(message.downcast_ref::<String>().unwrap().contains("is the third"));
    assert_eq!(taken, 3);
}
