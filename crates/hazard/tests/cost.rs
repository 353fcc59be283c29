//! What a file costs its reader, and files made to cost much more than they weigh.
#![allow(dead_code)] // no program of tests uses all of it

use std::io::{self, Read};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use flate2::{Compression, write::GzEncoder};

/// The most memory this process has had, bytes; the tests of a program run in it one beside the other.
pub(crate) fn peak_bytes() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1024 * line.trim().strip_suffix("kB")?.trim().parse::<usize>().ok()?)
}

/// 100 MB of each of `bytes`, packed into 100 kB.
pub(crate) fn bombs(bytes: &[u8]) -> Vec<Vec<u8>> {
    let bomb = |byte| {
        let mut bomb = GzEncoder::new(Vec::new(), Compression::best());
        io::copy(&mut io::repeat(byte).take(100 << 20), &mut bomb).unwrap();
        bomb.finish().unwrap()
    };
    let bombs: Vec<_> = std::thread::scope(|scope| {
        let packing: Vec<_> = bytes.iter().map(|&byte| scope.spawn(move || bomb(byte))).collect();
        packing.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(bombs.iter().all(|bomb| bomb.len() < 200_000));
    bombs
}

/// Holds `read` to a minute, and all that are read so in this process to 300 MB together.
pub(crate) fn costs_little(read: impl FnOnce()) {
    static BEFORE: OnceLock<Option<usize>> = OnceLock::new();
    let (before, begin) = (*BEFORE.get_or_init(peak_bytes), Instant::now());
    read();
    assert!(begin.elapsed() < Duration::from_secs(60), "{:?}", begin.elapsed());
    match (before, peak_bytes()) {
        (Some(before), Some(after)) => {
            println!("{:?}, {} MB more at the peak", begin.elapsed(), (after - before) >> 20);
            assert!(after - before < 300 << 20, "{} bytes", after - before);
        }
        _ => println!("skipped: this system does not say how much memory a process has had"),
    }
}
