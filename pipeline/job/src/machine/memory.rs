//! Memory that there is, and that is free.

use super::Limit;

/// What there is of memory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Memory {
    /// What a job can have at most: the least of the machine's memory with its swap, of the limits of control groups,
    /// and of those of this process.
    pub most: Option<Limit>,
    /// What it can have now without disturbing others.
    pub available: Option<Limit>,
}

/// The memory of this machine for this process.
#[cfg(target_os = "linux")]
pub fn memory() -> Memory {
    let root = std::path::Path::new("/");
    let mut memory = system_memory(root);
    memory.most = Limit::least(memory.most.into_iter().chain(own_limits(root)));
    memory
}

/// The memory of this machine: unknown on this system.
#[cfg(not(target_os = "linux"))]
pub fn memory() -> Memory {
    Memory::default()
}

/// That of the machine whose files are below `root`, and of the control groups that this process is in.
#[cfg(target_os = "linux")]
fn system_memory(root: &std::path::Path) -> Memory {
    let text = std::fs::read_to_string(root.join("proc/meminfo")).unwrap_or_default();
    let value = |name: &str| kilobytes(&text, name);
    let swap = value("SwapTotal").unwrap_or(0);
    let machine = value("MemTotal").map(|total| Limit::new(total.saturating_add(swap), "this machine, with its swap"));
    let free = value("MemAvailable").map(|free| Limit::new(free, "free on this machine"));
    let groups = super::control_group::limits(root, swap);
    let most = groups.iter().filter_map(|group| group.most.clone());
    let available = groups.iter().filter_map(|group| group.available.clone());
    Memory {
        most: Limit::least(machine.into_iter().chain(most)),
        available: Limit::least(free.into_iter().chain(available)),
    }
}

/// What the limits of this process on its address space and on its data leave for what a job needs, which counts
/// what is resident already.
#[cfg(target_os = "linux")]
fn own_limits(root: &std::path::Path) -> Vec<Limit> {
    let status = std::fs::read_to_string(root.join("proc/self/status")).unwrap_or_default();
    let value = |name: &str| kilobytes(&status, name).unwrap_or(0);
    // reserved, not filled: stacks of threads and the program itself
    let beside = |reserved: &str| value(reserved).saturating_sub(value("VmRSS"));
    [
        ("Max address space", "VmSize", "the address space of this process: ulimit -v"),
        ("Max data size", "VmData", "the data of this process: ulimit -d"),
    ]
    .into_iter()
    .filter_map(|(resource, reserved, of)| {
        super::process_limits::limit(root, resource).map(|most| Limit::new(most.saturating_sub(beside(reserved)), of))
    })
    .collect()
}

/// The value of the line `name: 123 kB`, in bytes.
#[cfg(target_os = "linux")]
fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let rest = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'))?;
    let number: u64 = rest.split_whitespace().next()?.parse().ok()?;
    Some(number.saturating_mul(1024))
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn this_machine_has_memory_and_some_of_it_is_free() {
        let memory = memory();
        assert!(memory.most.unwrap().bytes > 100_000_000);
        assert!(memory.available.unwrap().bytes > 0);
    }

    #[test]
    fn memory_and_swap_of_the_machine() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(root.path().join("proc")).unwrap();
        let text =
            "MemTotal:        1000 kB\nMemFree:          10 kB\nMemAvailable:    600 kB\nSwapTotal:       500 kB\n";
        std::fs::write(root.path().join("proc/meminfo"), text).unwrap();
        let memory = system_memory(root.path());
        assert_eq!(memory.most.unwrap().bytes, 1500 * 1024);
        assert_eq!(memory.available.unwrap().bytes, 600 * 1024);
        assert_eq!(system_memory(&root.path().join("nothing here")), Memory::default());
    }
}
