//! Limits of the control groups that a process is in (cgroups of Linux, versions 1 and 2): its own and those above it,
//! as containers and batch systems set them.

use std::fs;
use std::path::{Path, PathBuf};

use super::Limit;

/// What a control group leaves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct GroupLimit {
    /// At most.
    pub(super) most: Option<Limit>,
    /// Now.
    pub(super) available: Option<Limit>,
}

/// Names of the files of one version.
struct Files {
    /// Hard limit, and the one above which the system slows down, if there is one.
    limits: &'static [&'static str],
    used: &'static str,
    /// Memory that only keeps copies of files, in `memory.stat`.
    cached: [&'static str; 2],
    swap: Option<&'static str>,
}

const VERSION_1: Files = Files {
    limits: &["memory.limit_in_bytes"],
    used: "memory.usage_in_bytes",
    cached: ["total_active_file", "total_inactive_file"],
    swap: None,
};
const VERSION_2: Files = Files {
    limits: &["memory.max", "memory.high"],
    used: "memory.current",
    cached: ["active_file", "inactive_file"],
    swap: Some("memory.swap.max"),
};

/// The limits of every control group of this process on the machine whose files are below `root`, which has so much
/// `swap_bytes`.
pub(super) fn limits(root: &Path, swap_bytes: u64) -> Vec<GroupLimit> {
    let read = |file: &str| fs::read_to_string(root.join("proc/self").join(file)).unwrap_or_default();
    let (groups, mounts) = (read("cgroup"), read("mountinfo"));
    let mut found = Vec::new();
    for line in groups.lines() {
        // 0::/user.slice, or 5:cpu,memory:/user.slice
        let mut parts = line.splitn(3, ':');
        let (Some(number), Some(controllers), Some(group)) = (parts.next(), parts.next(), parts.next()) else {
            continue;
        };
        let files = match (number, controllers) {
            ("0", "") => &VERSION_2,
            (_, controllers) if controllers.split(',').any(|controller| controller == "memory") => &VERSION_1,
            _ => continue,
        };
        let Some((top, folder)) = folder_of(group, &mounts, files.swap.is_some()) else { continue };
        let (top, folder) = (below(root, &top), below(root, &folder));
        found.extend(folder.ancestors().take_while(|above| above.starts_with(&top)).map(|folder| {
            let shown = Path::new("/").join(folder.strip_prefix(root).unwrap_or(folder));
            limit_of(folder, &shown, files, swap_bytes)
        }));
    }
    found
}

/// Where the hierarchy is mounted, and the folder of `group` in it.
fn folder_of(group: &str, mounts: &str, second_version: bool) -> Option<(PathBuf, PathBuf)> {
    mounts.lines().find_map(|line| {
        // 30 24 0:26 / /sys/fs/cgroup rw,nosuid - cgroup2 cgroup2 rw
        let (place, system) = line.split_once(" - ")?;
        let mut system = system.split(' ');
        let (kind, options) = (system.next()?, system.nth(1).unwrap_or_default());
        let matches = if second_version {
            kind == "cgroup2"
        } else {
            kind == "cgroup" && options.split(',').any(|option| option == "memory")
        };
        if !matches {
            return None;
        }
        let mut place = place.split(' ').skip(3);
        let (mounted, at) = (place.next()?, PathBuf::from(place.next()?));
        // within a container the group may lie outside of what is mounted: then the top is what is seen of it
        let inside = Path::new(group).strip_prefix(mounted).unwrap_or(Path::new(""));
        let folder = at.join(inside);
        Some((at, folder))
    })
}

fn below(root: &Path, path: &Path) -> PathBuf {
    root.join(path.strip_prefix("/").unwrap_or(path))
}

fn limit_of(folder: &Path, shown: &Path, files: &Files, swap_bytes: u64) -> GroupLimit {
    let number = |file: &str| -> Option<u64> { fs::read_to_string(folder.join(file)).ok()?.trim().parse().ok() };
    let swap = files.swap.and_then(number).map_or(swap_bytes, |most| most.min(swap_bytes));
    let named = |bytes, file: &str| Limit::new(bytes, format!("control group, {}", shown.join(file).display()));
    let hard = files.limits[0];
    let most = number(hard).map(|bytes| named(bytes.saturating_add(swap), hard));
    let statistics = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
    let cached: u64 = (statistics.lines())
        .filter_map(|line| line.split_once(' '))
        .filter(|(name, _)| files.cached.contains(name))
        .filter_map(|(_, value)| value.trim().parse::<u64>().ok())
        .sum();
    let used = number(files.used).unwrap_or(0).saturating_sub(cached);
    let available = files.limits.iter().filter_map(|&file| Some(named(number(file)?.saturating_sub(used), file)));
    GroupLimit { most, available: Limit::least(available) }
}

#[cfg(test)]
mod tests {
    use tempfile::TempDir;

    use super::*;

    /// A machine of such files.
    fn machine(files: &[(&str, &str)]) -> TempDir {
        let root = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = root.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        root
    }

    fn least(root: &TempDir, swap: u64) -> [Option<u64>; 2] {
        let found = limits(root.path(), swap);
        let most = found.iter().filter_map(|group| group.most.clone());
        let available = found.iter().filter_map(|group| group.available.clone());
        [Limit::least(most), Limit::least(available)].map(|limit| limit.map(|limit| limit.bytes))
    }

    #[test]
    fn the_second_version_from_the_own_group_upwards() {
        let root = machine(&[
            ("proc/self/cgroup", "0::/slurm/job/step\n"),
            ("proc/self/mountinfo", "30 24 0:26 / /sys/fs/cgroup rw,nosuid - cgroup2 cgroup2 rw\n"),
            ("sys/fs/cgroup/slurm/job/step/memory.max", "max\n"),
            ("sys/fs/cgroup/slurm/job/memory.max", "4000\n"),
            ("sys/fs/cgroup/slurm/job/memory.high", "3000\n"),
            ("sys/fs/cgroup/slurm/job/memory.swap.max", "100\n"),
            ("sys/fs/cgroup/slurm/job/memory.current", "1500\n"),
            ("sys/fs/cgroup/slurm/job/memory.stat", "anon 900\nactive_file 400\ninactive_file 200\n"),
            ("sys/fs/cgroup/slurm/memory.max", "9000\n"),
        ]);
        assert_eq!(least(&root, 500), [Some(4100), Some(2100)]);
        let found = limits(root.path(), 0);
        let named = found.iter().filter_map(|group| group.most.clone()).min_by_key(|limit| limit.bytes).unwrap();
        assert_eq!(named.of, "control group, /sys/fs/cgroup/slurm/job/memory.max");
    }

    #[test]
    fn the_first_version_in_a_container_that_sees_its_own_group_as_the_top() {
        let root = machine(&[
            ("proc/self/cgroup", "7:cpu,cpuacct:/x\n5:memory:/docker/abc\n0::/\n"),
            (
                "proc/self/mountinfo",
                "31 24 0:27 /docker/abc /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n\
                 32 24 0:28 / /sys/fs/cgroup/cpu ro - cgroup cgroup rw,cpu,cpuacct\n",
            ),
            ("sys/fs/cgroup/memory/memory.limit_in_bytes", "2000\n"),
            ("sys/fs/cgroup/memory/memory.usage_in_bytes", "700\n"),
            ("sys/fs/cgroup/memory/memory.stat", "total_inactive_file 300\n"),
        ]);
        assert_eq!(least(&root, 0), [Some(2000), Some(1600)]);
    }

    #[test]
    fn no_control_groups_no_limit() {
        assert_eq!(limits(machine(&[]).path(), 0), []);
        let unlimited = machine(&[
            ("proc/self/cgroup", "0::/\n"),
            ("proc/self/mountinfo", "30 24 0:26 / /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n"),
        ]);
        assert_eq!(least(&unlimited, 0), [None, None]);
    }
}
