#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

use std::any::Any;
use std::ffi::CStr;
use std::marker::PhantomData;
use std::os::raw::{c_int, c_uint, c_void};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::{fmt, ptr};

pub mod ffi;
pub use ffi::{Aabb, Grid};

mod sealed {
    pub trait Sealed {}
}

macro_rules! numbers {
    ($(#[$about:meta] $name:ident: $($type:ty)*;)*) => {
        $(#[$about] pub trait $name: sealed::Sealed {} $(impl sealed::Sealed for $type {} impl $name for $type {})*)*
    };
}
numbers! {
    /// A coordinate of a position: `f32` or `f64`.
    Coordinate: f32 f64;
    /// The number of a vertex: `u16` or `u32`.
    Index: u16 u32;
}

/// How accurate an answer has to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Accuracy {
    /// The true answer for every finite input, the same on every processor.
    Exact,
    /// Never misses an overlap; may report a triangle that misses the box within rounding of contact.
    Conservative,
    /// In single precision: may err either way within rounding of contact, and misses thin triangles.
    Fast,
}

/// Why there is no answer. The text of each is that of the C library.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error {
    /// A count, or the order of the axes, is not allowed.
    BadArgument = 1,
    /// A bound of the box is NaN or infinite.
    BadBox = 2,
    /// The grid is not finite, not positive, too large, or so fine that two planes are one number.
    BadGrid = 3,
    /// A triangle refers to a vertex that does not exist.
    BadVertex = 6,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(text(unsafe { ffi::tribox_status_text(*self as ffi::Status) }))
    }
}

impl std::error::Error for Error {}

/// Text in static storage of the C library, which is ASCII.
fn text(c: *const std::os::raw::c_char) -> &'static str {
    unsafe { CStr::from_ptr(c) }.to_str().unwrap_or("")
}

fn check(status: ffi::Status) -> Result<(), Error> {
    match status {
        0 => Ok(()),
        1 => Err(Error::BadArgument),
        2 => Err(Error::BadBox),
        3 => Err(Error::BadGrid),
        6 => Err(Error::BadVertex),
        n => unreachable!("{}", text(unsafe { ffi::tribox_status_text(n) })), // about options that are not given here
    }
}

/// The version of the C library, such as "1.0.0".
pub fn version() -> &'static str {
    text(unsafe { ffi::tribox_version() })
}

/// Triangles that are borrowed where they lie, of floats or doubles; nothing is copied or checked until a call reads them.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    c: ffi::Mesh,
    borrowed: PhantomData<&'a [u8]>,
}

// The pointers are to slices that are borrowed for reading, of numbers.
unsafe impl Send for Mesh<'_> {}
unsafe impl Sync for Mesh<'_> {}

impl<'a> Mesh<'a> {
    /// An indexed mesh. The first three of a position's numbers are its x, y and z; others, such as a normal, are skipped.
    ///
    /// # Panics
    ///
    /// If positions have fewer than three numbers.
    pub fn new<C: Coordinate, I: Index, const N: usize>(positions: &'a [[C; N]], triangles: &'a [[I; 3]]) -> Self {
        let mut mesh = Self::unindexed(&positions[..0]);
        mesh.c.positions = positions.as_ptr().cast();
        mesh.c.vertices = positions.len();
        mesh.c.indices = triangles.as_ptr().cast();
        mesh.c.index_bytes = std::mem::size_of::<I>() as c_uint;
        mesh.c.count = triangles.len();
        mesh
    }

    /// Triangles whose vertices follow each other: 0, 1 and 2 are those of the first.
    ///
    /// # Panics
    ///
    /// If positions have fewer than three numbers, or their count is no multiple of three.
    pub fn unindexed<C: Coordinate, const N: usize>(positions: &'a [[C; N]]) -> Self {
        assert!(N >= 3, "positions have {N} numbers");
        assert!(positions.len() % 3 == 0, "{} vertices are no triangles", positions.len());
        let c = ffi::Mesh {
            positions: positions.as_ptr().cast(),
            stride: N * std::mem::size_of::<C>(),
            vertices: positions.len(),
            indices: ptr::null(),
            index_bytes: 0,
            count: positions.len() / 3,
            position_bytes: std::mem::size_of::<C>() as c_uint,
            axis_stride: 0,
            axes: 0,
            reserved: [0; 4],
        };
        Mesh { c, borrowed: PhantomData }
    }

    /// Names the stored numbers anew: 231 takes the second for x, the third for y and the first for z. 0 and 123 are as stored.
    pub fn with_axes(mut self, axes: u32) -> Self {
        self.c.axes = axes;
        self
    }

    /// The mesh as functions of C take it.
    pub fn as_ffi(&self) -> &ffi::Mesh {
        &self.c
    }
}

/// The numbers of the bits that are set, in rising order.
fn bits(word: u64) -> impl Iterator<Item = u32> {
    std::iter::successors(Some(word), |w| Some(w & w.wrapping_sub(1))).take_while(|&w| w != 0).map(u64::trailing_zeros)
}

/// Which triangles overlap: a bit for each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    words: Vec<u64>,
    triangles: usize,
    overlapping: usize,
}

impl Mask {
    /// Whether this triangle overlaps. Panics if there is no such triangle.
    pub fn get(&self, triangle: usize) -> bool {
        assert!(triangle < self.triangles, "triangle {triangle} of {}", self.triangles);
        self.words[triangle / 64] >> (triangle % 64) & 1 != 0
    }

    /// The triangles that overlap, in rising order.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.words.iter().enumerate().flat_map(|(n, &word)| bits(word).map(move |b| 64 * n + b as usize))
    }

    /// How many triangles overlap.
    pub fn overlapping(&self) -> usize {
        self.overlapping
    }

    /// The bits: triangle `i` is bit `i % 64` of word `i / 64`.
    pub fn words(&self) -> &[u64] {
        &self.words
    }
}

/// Which triangles of a mesh overlap the box.
///
/// ```
/// use tribox::{overlap, Aabb, Accuracy, Error, Mesh};
///
/// let positions = [[0.0f32, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [5.0, 5.0, 5.0], [6.0, 5.0, 5.0]];
/// let mesh = Mesh::new(&positions, &[[0u32, 1, 2], [2, 3, 4]]);
/// let mask = overlap(&mesh, &Aabb { lo: [-1.0; 3], hi: [1.0; 3] }, Accuracy::Exact)?;
/// assert_eq!(mask.iter().collect::<Vec<_>>(), [0]);
/// assert_eq!(overlap(&mesh, &Aabb { lo: [f64::NAN; 3], hi: [1.0; 3] }, Accuracy::Exact), Err(Error::BadBox));
/// # Ok::<(), Error>(())
/// ```
pub fn overlap(mesh: &Mesh, aabb: &Aabb, accuracy: Accuracy) -> Result<Mask, Error> {
    let accuracy = accuracy as c_uint;
    let options = ffi::Options { accuracy, axes: 0, axis_order: 0, kernel: ptr::null(), reserved: [0; 4] };
    let (mut words, mut report) = (vec![0; (mesh.c.count + 63) / 64], ffi::Report::default());
    check(unsafe { ffi::tribox_mesh_overlap(&mesh.c, aabb, &options, words.as_mut_ptr(), &mut report) })?;
    Ok(Mask { words, triangles: mesh.c.count, overlapping: report.overlapping })
}

impl Grid {
    /// The box of a cell, which is the one that its triangles are tested with. Panics if the grid has no such cell.
    pub fn cell_box(&self, cell: [u32; 3]) -> Aabb {
        assert!((0..3).all(|a| cell[a] < self.size[a]), "cell {cell:?} of {:?}", self.size);
        unsafe { ffi::tribox_grid_cell(self, cell[0], cell[1], cell[2]) }
    }
}

/// The cells of a grid: a bit for each.
#[derive(Clone, Debug, PartialEq)]
pub struct Voxels {
    grid: Grid,
    words: Vec<u64>,
    count: usize,
}

impl Voxels {
    /// No cell is set.
    pub fn new(grid: &Grid) -> Result<Self, Error> {
        match unsafe { ffi::tribox_window_words(grid.size.as_ptr()) } {
            words if words as u64 <= 1 << 31 => Ok(Voxels { grid: *grid, words: vec![0; words], count: 0 }),
            _ => Err(Error::BadGrid),
        }
    }

    /// Sets also the cells that a triangle of this mesh overlaps. Returns how many were not set before.
    pub fn add(&mut self, mesh: &Mesh) -> Result<usize, Error> {
        let (words, mut report) = (self.words.as_mut_ptr(), ffi::Report::default());
        check(unsafe { ffi::tribox_mesh_voxelize(&mesh.c, &self.grid, ptr::null(), ptr::null(), words, &mut report) })?;
        self.count += report.overlapping;
        Ok(report.overlapping)
    }

    /// These cells and all that they enclose: what cannot be reached from outside the grid across faces of clear cells.
    pub fn filled(&self) -> Result<Voxels, Error> {
        let (size, mut solid, mut inside) = (self.grid.size.as_ptr(), vec![0; self.words.len()], 0);
        let mut scratch = vec![0u8; unsafe { ffi::tribox_fill_bytes(size) }];
        let (from, to) = (self.words.as_ptr(), solid.as_mut_ptr());
        check(unsafe { ffi::tribox_fill_outside(size, from, scratch.as_mut_ptr().cast(), to, &mut inside) })?;
        Ok(Voxels { grid: self.grid, words: solid, count: self.count + inside })
    }

    /// Whether a cell is set. Outside the grid none is.
    pub fn get(&self, [i, j, k]: [u32; 3]) -> bool {
        let [nx, ny, nz] = self.grid.size;
        let word = || self.words[(k as usize * ny as usize + j as usize) * self.words_of_row() + i as usize / 64];
        i < nx && j < ny && k < nz && word() >> (i % 64) & 1 != 0
    }

    /// The cells that are set, as `[i, j, k]`, by z, then y, then x.
    pub fn iter(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let (width, ny) = (self.words_of_row().max(1), (self.grid.size[1] as usize).max(1));
        self.words.iter().enumerate().filter(|(_, &word)| word != 0).flat_map(move |(n, &word)| {
            let (i, j, k) = ((64 * (n % width)) as u32, (n / width % ny) as u32, (n / width / ny) as u32);
            bits(word).map(move |b| [i + b, j, k])
        })
    }

    /// How many cells are set.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The bits: cell `[i, j, k]` is bit `i % 64` of word `(k * size[1] + j) * w + i / 64`, where `w` is `size[0]` by 64, rounded up.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    fn words_of_row(&self) -> usize {
        (self.grid.size[0] as usize + 63) / 64
    }
}

/// Which cells of the grid a triangle of the mesh overlaps: exactly those whose [`Grid::cell_box`] it touches.
///
/// ```
/// use tribox::{voxelize, Grid, Mesh};
///
/// let triangle = [[0.5f32, 0.5, 0.5], [3.4, 0.5, 0.5], [0.5, 3.4, 0.5]];
/// let grid = Grid { origin: [0.0; 3], cell: [1.0; 3], size: [4, 4, 4] };
/// let voxels = voxelize(&Mesh::unindexed(&triangle), &grid)?;
/// assert_eq!(voxels.count(), 10);
/// assert!(voxels.get([3, 0, 0]) && !voxels.get([3, 1, 0]));
/// assert_eq!(voxels.iter().last(), Some([0, 3, 0]));
/// # Ok::<(), tribox::Error>(())
/// ```
pub fn voxelize(mesh: &Mesh, grid: &Grid) -> Result<Voxels, Error> {
    let mut voxels = Voxels::new(grid)?;
    voxels.add(mesh)?;
    Ok(voxels)
}

/// 8 x 8 x 8 cells of a grid, at least one of them set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Brick {
    /// The number of the brick along each axis: its cells are from `8 * at[0]` on along x, and so on.
    pub at: [u32; 3],
    /// Cell `[i, j, k]` of the brick is bit `i + 8 * j` of word `k`.
    pub bits: [u64; 8],
}

impl Brick {
    /// The cells that are set, as `[i, j, k]` of the grid, by z, then y, then x.
    pub fn cells(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let [x, y, z] = self.at.map(|at| 8 * at);
        self.bits.iter().zip(0..).flat_map(move |(&word, k)| bits(word).map(move |b| [x + b % 8, y + b / 8, z + k]))
    }
}

/// What bricks are handed to, and the panic that ended the call.
struct Taker<F> {
    take: F,
    panic: Option<Box<dyn Any + Send>>,
}

/// No panic may cross C: it is kept, and ends the call.
unsafe extern "C" fn hand<F: FnMut(&Brick)>(data: *mut c_void, at: *const u32, bits: *const u64) -> c_int {
    let taker = &mut *data.cast::<Taker<F>>();
    let brick = Brick { at: *at.cast(), bits: *bits.cast() };
    match catch_unwind(AssertUnwindSafe(|| (taker.take)(&brick))) {
        Ok(()) => 0,
        Err(panic) => {
            taker.panic = Some(panic);
            1
        }
    }
}

/// The cells of [`voxelize`] without memory for those that are clear: hands each brick that is not empty to a function, once.
/// Returns how many cells are set. If the function panics, so does this call.
///
/// ```
/// use tribox::{bricks, Grid, Mesh};
///
/// let triangle = [[0.5f32, 0.5, 0.5], [999.5, 0.5, 0.5], [0.5, 0.5, 0.5]]; // a segment
/// let grid = Grid { origin: [0.0; 3], cell: [1.0; 3], size: [1 << 14; 3] };
/// let mut cells = Vec::new();
/// let count = bricks(&Mesh::unindexed(&triangle), &grid, |brick| cells.extend(brick.cells()))?;
/// assert_eq!((count, cells.len(), cells[999]), (1000, 1000, [999, 0, 0]));
/// # Ok::<(), tribox::Error>(())
/// ```
pub fn bricks<F: FnMut(&Brick)>(mesh: &Mesh, grid: &Grid, take: F) -> Result<usize, Error> {
    const SIDE: u32 = 128; // suits the caches
    const SHARE: usize = 1 << 20; // lists of so many tiles begin in 8 MB
    let all = unsafe { ffi::tribox_tile_count(grid.size.as_ptr(), SIDE) };
    if all == usize::MAX {
        return Err(Error::BadGrid);
    }
    let mut scratch = vec![0u8; unsafe { ffi::tribox_bricks_bytes(SIDE) }];
    let mut taker = Taker { take, panic: None };
    let mut cells = 0;
    for first in (0..all.max(1)).step_by(SHARE) {
        // A grid that has no tiles is refused by the first call.
        let tiles = ffi::Tiles { side: SIDE, first, count: SHARE.min(all - first) };
        let (mut starts, mut report) = (vec![0; tiles.count + 1], ffi::Report::default());
        let lists = |starts: &mut Vec<usize>, list| {
            check(unsafe { ffi::tribox_mesh_tile_lists(&mesh.c, grid, &tiles, ptr::null(), starts.as_mut_ptr(), list) })
        };
        lists(&mut starts, ptr::null_mut())?;
        let mut list = vec![0; starts[tiles.count]];
        lists(&mut starts, list.as_mut_ptr())?;
        let sink = ffi::Sink { take: Some(hand::<F>), data: (&mut taker as *mut Taker<F>).cast() };
        let (from, to, scratch) = (starts.as_ptr(), list.as_ptr(), scratch.as_mut_ptr().cast());
        let status = unsafe { ffi::tribox_mesh_bricks(&mesh.c, grid, &tiles, from, to, ptr::null(), scratch, &sink, &mut report) };
        if let Some(panic) = taker.panic.take() {
            resume_unwind(panic);
        }
        check(status)?;
        cells += report.overlapping;
    }
    Ok(cells)
}
