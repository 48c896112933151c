//! The C interface: names, arguments and meaning are those of `tribox.h`. Its other functions may be declared with these types.
#![allow(missing_docs)]
use std::os::raw::{c_char, c_int, c_uint, c_void};

/// `tribox_status`.
pub type Status = c_uint;

/// Structs of C, and their test's lines: an assertion for each size and offset.
macro_rules! structs {
    ($($(#[$about:meta])* $name:ident { $($(#[$what:meta])* $field:ident: $type:ty,)* })*) => {
        $($(#[$about])* #[repr(C)] #[derive(Clone, Copy, Debug)] pub struct $name { $($(#[$what])* pub $field: $type,)* })*

        #[cfg(test)]
        fn structs() -> String {
            let mut text = String::new();
            $(
                let (all, c) = (std::mem::MaybeUninit::<$name>::uninit(), tests::in_c(stringify!($name)));
                text += &format!("_Static_assert(sizeof({c}) == {}, \"\");\n", std::mem::size_of::<$name>());
                $(
                    let at = unsafe { std::ptr::addr_of!((*all.as_ptr()).$field) as usize } - all.as_ptr() as usize;
                    let (field, bytes) = (stringify!($field), std::mem::size_of::<$type>());
                    text += &format!("_Static_assert(offsetof({c}, {field}) == {at}, \"\");\n");
                    text += &format!("_Static_assert(sizeof((({c} *)0)->{field}) == {bytes}, \"\");\n");
                )*
            )*
            text
        }
    };
}

/// Functions of C, and their test's lines: each declared once more.
macro_rules! functions {
    ($(fn $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        extern "C" { $(pub fn $name($($argument: $type),*) -> $result;)* }

        #[cfg(test)]
        fn functions() -> Vec<(&'static str, &'static str, Vec<&'static str>)> {
            vec![$((stringify!($name), stringify!($result), vec![$(stringify!($type)),*])),*]
        }
    };
}

structs! {
    /// A closed box with its faces along the axes: `tribox_box`. Nothing overlaps an empty one, of which a `lo` exceeds its `hi`.
    #[derive(PartialEq)]
    Aabb {
        /// The lower bounds along x, y and z.
        lo: [f64; 3],
        /// The upper bounds.
        hi: [f64; 3],
    }

    /// A grid of closed cells: `tribox_grid`. Plane `p` along an axis lies at the double nearest to `origin + p * cell`.
    #[derive(PartialEq)]
    Grid {
        /// The lower corner of cell `[0, 0, 0]`.
        origin: [f64; 3],
        /// The lengths of a cell, which need not be a cube.
        cell: [f64; 3],
        /// The number of cells along each axis.
        size: [u32; 3],
    }

    Mesh {
        positions: *const c_void, stride: usize, vertices: usize, indices: *const c_void, index_bytes: c_uint, count: usize,
        position_bytes: c_uint, axis_stride: usize, axes: c_uint, reserved: [u32; 4],
    }
    Options { accuracy: c_uint, axes: c_uint, axis_order: c_uint, kernel: *const c_char, reserved: [u32; 4], }
    #[derive(Default)]
    Report { overlapping: usize, undecided: usize, }
    Window { first: [u32; 3], size: [u32; 3], }
    Tiles { side: u32, first: usize, count: usize, }
    Sink { take: Option<unsafe extern "C" fn(*mut c_void, *const u32, *const u64) -> c_int>, data: *mut c_void, }
}

functions! {
    fn tribox_version() -> *const c_char;
    fn tribox_status_text(status: Status) -> *const c_char;
    fn tribox_mesh_overlap(mesh: *const Mesh, aabb: *const Aabb, options: *const Options, mask: *mut u64, report: *mut Report)
        -> Status;
    fn tribox_grid_cell(grid: *const Grid, i: u32, j: u32, k: u32) -> Aabb;
    fn tribox_window_words(size: *const u32) -> usize;
    fn tribox_mesh_voxelize(mesh: *const Mesh, grid: *const Grid, window: *const Window, options: *const Options,
        occupied: *mut u64, report: *mut Report) -> Status;
    fn tribox_fill_bytes(size: *const u32) -> usize;
    fn tribox_fill_outside(size: *const u32, occupied: *const u64, scratch: *mut c_void, solid: *mut u64, inside: *mut usize)
        -> Status;
    fn tribox_tile_count(size: *const u32, side: u32) -> usize;
    fn tribox_mesh_tile_lists(mesh: *const Mesh, grid: *const Grid, tiles: *const Tiles, options: *const Options,
        starts: *mut usize, list: *mut u32) -> Status;
    fn tribox_bricks_bytes(side: u32) -> usize;
    fn tribox_mesh_bricks(mesh: *const Mesh, grid: *const Grid, tiles: *const Tiles, starts: *const usize, list: *const u32,
        options: *const Options, scratch: *mut c_void, sink: *const Sink, report: *mut Report) -> Status;
}

#[cfg(test)]
mod tests {
    use crate::{Accuracy, Error};
    use std::io::Write;
    use std::process::{Command, Stdio};

    /// A type of Rust in C: `*const Mesh` as `const tribox_mesh *`.
    pub fn in_c(rust: &str) -> String {
        match rust.split_once(' ') {
            Some(("*const", to)) => format!("const {} *", in_c(to)),
            Some(("*mut", to)) => format!("{} *", in_c(to)),
            _ => match rust {
                "u32" | "u64" => format!("uint{}_t", &rust[1..]),
                "usize" => "size_t".into(),
                "c_char" | "c_void" => rust[2..].into(),
                "Aabb" => "tribox_box".into(),
                name => format!("tribox_{}", name.to_lowercase()),
            },
        }
    }

    /// The C compiler agrees about every struct and function: it refuses a wrong assertion and another declaration.
    #[test]
    fn header_agrees() {
        let mut text = String::from("#include <tribox.h>\n") + &super::structs();
        for (name, value) in [
            ("sizeof(tribox_status)", 4),
            ("TRIBOX_EXACT", Accuracy::Exact as u32),
            ("TRIBOX_CONSERVATIVE", Accuracy::Conservative as u32),
            ("TRIBOX_FAST", Accuracy::Fast as u32),
            ("TRIBOX_BAD_ARGUMENT", Error::BadArgument as u32),
            ("TRIBOX_BAD_BOX", Error::BadBox as u32),
            ("TRIBOX_BAD_GRID", Error::BadGrid as u32),
            ("TRIBOX_BAD_VERTEX", Error::BadVertex as u32),
        ] {
            text += &format!("_Static_assert({name} == {value}, \"\");\n");
        }
        for (name, result, types) in super::functions() {
            let types: Vec<_> = types.into_iter().map(in_c).collect();
            let list = if types.is_empty() { "void".into() } else { types.join(", ") };
            text += &format!("{} {name}({list});\n", in_c(result));
        }
        let cc = std::env::var("CC").unwrap_or_else(|_| "cc".into());
        let mut compiler = Command::new("sh")
            .args(["-c", &format!("{cc} -std=c11 -fsyntax-only -x c - -I'{}'", env!("TRIBOX_INCLUDE"))])
            .stdin(Stdio::piped())
            .spawn()
            .expect("a shell");
        compiler.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
        assert!(compiler.wait().unwrap().success(), "tribox.h is not what ffi.rs says:\n{text}");
    }
}
