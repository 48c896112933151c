//! Compiles tribox's C: `csrc`, which a package has, or else the sources of the clone in which this folder lies. CC, AR and CFLAGS
//! are read as by the crate cc, with `_` and the target after them for another machine.
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{env, fs, thread};

fn var(name: &str) -> String {
    env::var(name).unwrap_or_else(|_| panic!("cargo sets no {name}"))
}

/// The words of the variable for the target, those of the plain one if the target is this machine, or the default.
fn words(name: &str, default: &str) -> Vec<String> {
    let (target, is_host) = (var("TARGET"), var("TARGET") == var("HOST"));
    let special = format!("{name}_{}", target.replace(['-', '.'], "_"));
    println!("cargo:rerun-if-env-changed={name}");
    println!("cargo:rerun-if-env-changed={special}");
    let set = env::var(&special).or_else(|e| if is_host { env::var(name) } else { Err(e) });
    let text = set.unwrap_or_else(|_| if is_host || name == "CFLAGS" { default.into() } else { panic!("set {special}") });
    text.split_whitespace().map(String::from).collect()
}

fn run(words: &[String], arguments: impl FnOnce(&mut Command) -> &mut Command) {
    let mut command = Command::new(&words[0]);
    let status = arguments(command.args(&words[1..])).status();
    assert!(matches!(status, Ok(ended) if ended.success()), "{command:?}: {status:?}");
}

fn find(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.expect("a name in that folder").path();
        if path.is_dir() {
            find(&path, found);
        } else if path.extension().map_or(false, |end| end == "c") {
            found.push(path);
        }
    }
}

fn main() {
    let here = PathBuf::from(var("CARGO_MANIFEST_DIR"));
    let (packed, clone) = (here.join("csrc"), here.join("../.."));
    let (sources, includes) = if packed.join("tribox.h").exists() {
        (packed.clone(), vec![packed])
    } else if clone.join("include/tribox.h").exists() {
        (clone.join("src"), vec![clone.join("include"), clone.join("src")])
    } else {
        panic!("there is no {}: packaging/rust/build.sh, in a clone of tribox, makes a package that has it", packed.display())
    };
    let mut files = Vec::new();
    find(&sources, &mut files);
    files.sort();
    println!("cargo:rustc-env=TRIBOX_INCLUDE={}", includes[0].display()); // for the test of ffi.rs
    for folder in &includes {
        println!("cargo:rerun-if-changed={}", folder.display());
    }

    // Optimised also in a debug build, which is one of what uses it: -O0 makes it some ten times as slow.
    let out = PathBuf::from(var("OUT_DIR"));
    let (cc, flags, next) = (words("CC", "cc"), words("CFLAGS", ""), AtomicUsize::new(0));
    let pic = if var("CARGO_CFG_TARGET_FAMILY") == "unix" { Some("-fPIC") } else { None };
    let objects: Vec<_> = (0..files.len()).map(|n| out.join(format!("{n}.o"))).collect();
    let compile = |n: usize| {
        let include = includes.iter().map(|folder| format!("-I{}", folder.display()));
        run(&cc, |c| c.arg("-O2").args(pic).args(include).args(&flags).arg("-c").arg(&files[n]).arg("-o").arg(&objects[n]));
    };
    thread::scope(|scope| {
        for _ in 0..var("NUM_JOBS").parse().unwrap_or(1) {
            scope.spawn(|| loop {
                match next.fetch_add(1, Ordering::Relaxed) {
                    n if n < files.len() => compile(n),
                    _ => break,
                }
            });
        }
    });
    let library = out.join("libtribox.a");
    let _ = fs::remove_file(&library);
    run(&words("AR", "ar"), |c| c.arg("crs").arg(&library).args(&objects));
    println!("cargo:rustc-link-search=native={}", out.display());
    println!("cargo:rustc-link-lib=static=tribox");
    if pic.is_some() {
        println!("cargo:rustc-link-lib=m");
    }
}
