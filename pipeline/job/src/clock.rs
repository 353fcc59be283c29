//! The time of day, as files say it.

use std::time::{Duration, SystemTime};

/// Coordinated universal time, `2026-01-31T12:00:00Z`.
pub fn now() -> String {
    timestamp(SystemTime::now())
}

/// A time as text; a clock that is set before 1970 or after 9999 stands at the end that is nearer.
fn timestamp(time: SystemTime) -> String {
    let last = SystemTime::UNIX_EPOCH + Duration::from_secs(LAST_SECOND);
    humantime::format_rfc3339_seconds(time.clamp(SystemTime::UNIX_EPOCH, last)).to_string()
}

/// Of the year 9999.
const LAST_SECOND: u64 = 253_402_300_799;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_clock_stops_a_job() {
        let after = |seconds| SystemTime::UNIX_EPOCH + Duration::from_secs(seconds);
        assert_eq!(timestamp(after(1_767_225_600)), "2026-01-01T00:00:00Z");
        assert_eq!(timestamp(SystemTime::UNIX_EPOCH - Duration::from_secs(86_400)), "1970-01-01T00:00:00Z");
        assert_eq!(timestamp(after(LAST_SECOND)), "9999-12-31T23:59:59Z");
        assert_eq!(timestamp(after(LAST_SECOND + 1)), "9999-12-31T23:59:59Z");
    }
}
