//! Dates of the calendar as seconds.

/// Seconds from the beginning of 1970 to the given moment, both in the same time zone; none where the
/// moment is out of range: no such month, day of that month, hour, minute or second (a leap second, 60, is one),
/// or a year that no record file has.
///
/// # Source
///
/// Gregorian calendar: 146097 days in 400 years, and in a year that begins with March (so that the leap day
/// is its last) 153 days in every five months.
pub(super) fn seconds_since_1970(year: i64, month: u32, day: u32, hour: u32, minute: u32, second: f64) -> Option<f64> {
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let days_of_month = match month {
        2 => 28 + u32::from(leap),
        4 | 6 | 9 | 11 => 30,
        1 | 3 | 5 | 7 | 8 | 10 | 12 => 31,
        _ => return None,
    };
    let within = (0..=9999).contains(&year) && (1..=days_of_month).contains(&day) && hour < 24 && minute < 60;
    if !(within && (0.0..61.0).contains(&second)) {
        return None;
    }
    let since_march = i64::from((month + 9) % 12);
    let year = if month <= 2 { year - 1 } else { year };
    let leap_days = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    let days = 365 * year + leap_days + (153 * since_march + 2) / 5 + i64::from(day) - 1 - DAYS_TO_1970;
    Some((days * 86_400 + i64::from(hour) * 3600 + i64::from(minute) * 60) as f64 + second)
}

/// Seconds from the beginning of 1970 to a moment written as year, month, day, hour, minute and second, each
/// three joined in fixed width or apart: `20190728_160919.870`, `2018/01/24 19:51:43`; none for anything else.
pub(super) fn moment(text: &str) -> Option<f64> {
    let groups: Vec<&str> =
        text.split(|c: char| !c.is_ascii_digit() && c != '.').filter(|group| !group.is_empty()).take(7).collect();
    let ([year, month, day], time) = three_parts(&groups, 4)?;
    let ([hour, minute, second], []) = three_parts(time, 2)? else { return None };
    seconds_since_1970(
        year.parse().ok()?,
        month.parse().ok()?,
        day.parse().ok()?,
        hour.parse().ok()?,
        minute.parse().ok()?,
        second.parse().ok()?,
    )
}

/// The next three parts, the first of `width` digits and the others of two, and the groups behind them.
fn three_parts<'a, 'b>(groups: &'b [&'a str], width: usize) -> Option<([&'a str; 3], &'b [&'a str])> {
    match groups {
        [joined, rest @ ..] if joined.find('.').unwrap_or(joined.len()) == width + 4 => {
            Some(([joined.get(..width)?, joined.get(width..width + 2)?, joined.get(width + 2..)?], rest))
        }
        [first, second, third, rest @ ..] if first.len() == width => Some(([first, second, third], rest)),
        _ => None,
    }
}

/// Days from 1 March of the year 0 to the beginning of 1970.
const DAYS_TO_1970: i64 = 719_468;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_moments() {
        for (moment, seconds) in [
            ((1970, 1, 1, 0, 0, 0.0), 0.0),
            ((1970, 1, 1, 0, 0, 0.25), 0.25),
            ((1969, 12, 31, 23, 59, 59.0), -1.0),
            ((2000, 2, 29, 0, 0, 0.0), 951_782_400.0),
            ((2001, 9, 9, 1, 46, 40.0), 1e9),
            ((2009, 2, 13, 23, 31, 30.0), 1_234_567_890.0),
            ((2016, 12, 31, 23, 59, 60.0), 1_483_228_800.0),
            ((1906, 4, 18, 0, 0, 0.0), -2_010_441_600.0),
        ] {
            let (year, month, day, hour, minute, second) = moment;
            assert_eq!(seconds_since_1970(year, month, day, hour, minute, second), Some(seconds), "{moment:?}");
        }
    }

    #[test]
    fn no_such_moment() {
        for (year, month, day, hour, minute, second) in [
            (2019, 2, 29, 0, 0, 0.0),
            (1900, 2, 29, 0, 0, 0.0),
            (2019, 4, 31, 0, 0, 0.0),
            (2019, 0, 1, 0, 0, 0.0),
            (2019, 13, 1, 0, 0, 0.0),
            (2019, u32::MAX, 1, 0, 0, 0.0),
            (2019, 1, 0, 0, 0, 0.0),
            (2019, 1, 1, 24, 0, 0.0),
            (2019, 1, 1, 0, 60, 0.0),
            (2019, 1, 1, 0, 0, 61.0),
            (2019, 1, 1, 0, 0, -0.5),
            (2019, 1, 1, 0, 0, f64::NAN),
            (i64::MAX, 1, 1, 0, 0, 0.0),
            (i64::MIN, 1, 1, 0, 0, 0.0),
        ] {
            let found = seconds_since_1970(year, month, day, hour, minute, second);
            assert_eq!(found, None, "{year}-{month}-{day} {hour}:{minute}:{second}");
        }
    }

    #[test]
    fn moments_as_files_write_them() {
        let expected = seconds_since_1970(2019, 7, 28, 16, 9, 19.87);
        for text in
            ["20190728_160919.870", "2019/07/28 16:09:19.87", "2019-07-28T16:09:19.870Z", "20190728 16: 09:19.87"]
        {
            assert_eq!(moment(text), expected, "{text}");
        }
        assert_eq!(moment("1996/05/23 18: 36:00"), seconds_since_1970(1996, 5, 23, 18, 36, 0.0));
        for text in [
            "",
            "20190728",
            "20190728_",
            "20190728_1609",
            "16092019_160919",
            "20190728_999999",
            "2019/07/28 16:09",
            "20190728_160919 1",
            "2019.0728_160919",
            "99999999_999999",
            "é",
            "1 2 3 4 5 6 7 8",
        ] {
            assert_eq!(moment(text), None, "{text}");
        }
    }

    #[test]
    fn every_day_is_one_day_after_the_day_before() {
        let mut next = seconds_since_1970(1899, 12, 31, 0, 0, 0.0).unwrap();
        let mut days = 0;
        for (year, month, day) in (1900..2101).flat_map(|y| (1..13).flat_map(move |m| (1..32).map(move |d| (y, m, d))))
        {
            let Some(found) = seconds_since_1970(year, month, day, 0, 0, 0.0) else { continue };
            next += 86_400.0;
            assert_eq!(found, next, "{year}-{month}-{day}");
            days += 1;
        }
        // 201 years, 49 leap years among them: 1900 and 2100 are not.
        assert_eq!(days, 201 * 365 + 49);
    }

    proptest! {
        #[test]
        fn any_numbers_give_an_answer(
            year: i64, month in 0..40_u32, day: u32, hour: u32, minute: u32, second: f64, text in "[0-9./:_é -]{0,30}",
        ) {
            let _ = moment(&text);
            let _ = seconds_since_1970(year, month, day, hour, minute, second);
            let (year, month, day) = (year.rem_euclid(10_000), month % 12 + 1, day % 28 + 1);
            let found = seconds_since_1970(year, month, day, hour % 24, minute % 60, 0.5);
            prop_assert!(found.is_some());
        }
    }
}
