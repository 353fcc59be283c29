//! The limits of this process, as `ulimit` sets them.

use std::path::Path;

/// The limit `name` of this process on the machine whose files are below `root`, bytes; none where there is no limit,
/// or none is reported: Linux has it in a file.
pub(super) fn limit(root: &Path, name: &str) -> Option<u64> {
    let text = std::fs::read_to_string(root.join("proc/self/limits")).unwrap_or_default();
    let soft = text.lines().find_map(|line| line.strip_prefix(name)?.split_whitespace().next())?;
    soft.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_soft_limit_counts() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(root.path().join("proc/self")).unwrap();
        let text = "Limit                     Soft Limit           Hard Limit           Units\n\
                    Max file size             unlimited            unlimited            bytes\n\
                    Max address space         2000000              4000000              bytes\n";
        std::fs::write(root.path().join("proc/self/limits"), text).unwrap();
        assert_eq!(limit(root.path(), "Max address space"), Some(2_000_000));
        assert_eq!(limit(root.path(), "Max file size"), None);
        assert_eq!(limit(root.path(), "Max data size"), None);
    }
}
