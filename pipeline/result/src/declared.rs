//! How stored arrays are declared. A declaration is a constant beside the plain value whose field it names; writing,
//! reading, the tables of `docs/hdf5-layout.md` and the names in exports follow from it. Most are rows of a `group!`.
//! Add new rows at the end, marked `later`: a group is recognised by its first row that is not.

use std::ops::Range;

use uplift_job::Array;
use uplift_labelled::{GrowingArray, LabelledError, LabelledWriter, Number};
use uplift_motion::IntensityMeasure;
use uplift_risk::OrdinateFlag;

use super::layout::names::named;
pub use super::layout::names::{Names, measure_names};
use super::stored_result::StoredResult;
use crate::error::ResultError;

/// The flag of an ordinate that does not exist, of records that could not be repaired.
pub const NO_ORDINATE: u8 = 3;

/// An array of a result, and the field of the plain value `T` that it holds.
pub struct Quantity<T: 'static> {
    /// Its name within the group.
    pub name: &'static str,
    /// Its axes, the last one running fastest.
    pub axes: &'static [&'static str],
    /// Its unit; `1` where it has none.
    pub unit: &'static str,
    /// Its attribute `long_name`.
    pub long_name: &'static str,
    /// What `docs/hdf5-layout.md` says of it; empty where that is its `long_name`.
    pub note: &'static str,
    /// Its name in tables and exports, and its heading in a workbook. Of a group in which some have it, the others are
    /// in none of these; of other groups all are, by their own names.
    pub exported: Option<(&'static str, &'static str)>,
    /// Whether results of earlier versions lack it: its field then keeps what it held.
    pub is_later: bool,
    /// The field that it holds.
    pub field: Field<T>,
}

/// The field of a plain value that an array holds, value by value and row by row.
pub enum Field<T: 'static> {
    /// Floats.
    F64(Place<T, f64>),
    /// Counts.
    U32(Place<T, u32>),
    /// 1 for true.
    Bool(Place<T, bool>),
    /// Kinds of ordinates, as their numbers.
    Flag(Place<T, OrdinateFlag>),
    /// Texts.
    Text(Place<T, String>),
    /// Floats made of the value as they are written; read back as an array alone, if at all.
    Made(fn(&T, usize) -> f64),
}

/// Where the value at an index is, to read it and to change it.
pub struct Place<T, V> {
    /// The value at an index.
    pub get: fn(&T, usize) -> &V,
    /// The same, to be changed.
    pub get_mut: fn(&mut T, usize) -> &mut V,
}

/// A [`Quantity`] as a row: the name of the array, its axes (declared ones or names), type, unit, long name, in
/// brackets the note where it is another, after `as` its name in tables and exports and its heading where that is
/// another, and the field; `later` before all where earlier results lack it.
macro_rules! quantity {
    (
        $($later:ident)? $name:literal $axes:tt $kind:ident $unit:literal $long_name:literal $(($note:literal))?
            $(as $exported:literal $($heading:literal)?)? = |$of:ident, $at:ident| $field:expr
    ) => {
        $crate::declared::Quantity {
            name: $name,
            axes: &$crate::declared::quantity!(@axes $axes),
            unit: $unit,
            long_name: $long_name,
            note: concat!($($note)?),
            exported: $crate::declared::quantity!(@exported $($exported $($heading)?)?),
            is_later: $crate::declared::quantity!(@is_later $($later)?),
            field: $crate::declared::quantity!(@field $kind |$of, $at| $field),
        }
    };
    (@axes [$($axis:tt),* $(,)?]) => { [$($crate::declared::quantity!(@axis $axis)),*] };
    (@axis $name:literal) => { $name };
    (@axis $axis:ident) => { $axis.name };
    (@exported) => { None };
    (@exported $name:literal) => { Some(($name, $name)) };
    (@exported $name:literal $heading:literal) => { Some(($name, $heading)) };
    (@is_later) => { false };
    (@is_later later) => { true };
    (@field Made |$of:ident, $at:ident| $field:expr) => { $crate::declared::Field::Made(|$of, $at| $field) };
    (@field $kind:ident |$of:ident, $at:ident| $field:expr) => {
        $crate::declared::Field::$kind($crate::declared::Place {
            get: |$of, $at| &$field,
            get_mut: |$of, $at| &mut $field,
        })
    };
}
pub(crate) use quantity;

/// A [`Group`] as a table of such rows.
macro_rules! group {
    (
        $(#[$doc:meta])* pub const $group:ident: $value:ty = $path:expr;
        $($($later:ident)? $name:literal $axes:tt $kind:ident $unit:literal $long_name:literal $(($note:literal))?
            $(as $exported:literal $($heading:literal)?)? = |$of:ident, $at:ident| $field:expr;)+
    ) => {
        $(#[$doc])*
        pub const $group: $crate::declared::Group<$value> = $crate::declared::Group {
            path: $path,
            quantities: &[$($crate::declared::quantity!(
                $($later)? $name $axes $kind $unit $long_name $(($note))? $(as $exported $($heading)?)?
                    = |$of, $at| $field
            )),+],
        };
    };
}
pub(crate) use group;

/// The arrays of a group of the file. What stands in angle brackets is replaced by [`Names`]: a group each.
pub struct Group<T: 'static> {
    /// Its path.
    pub path: &'static str,
    /// Its arrays, in the order in which they are written.
    pub quantities: &'static [Quantity<T>],
}

/// Names and lengths of the axes that a group may use.
pub type Lengths<'a> = &'a [(&'a str, usize)];

impl<T> Quantity<T> {
    /// The type of its values, as `docs/hdf5-layout.md` names it.
    pub fn element(&self) -> &'static str {
        match &self.field {
            Field::F64(_) | Field::Made(_) => "f64",
            Field::U32(_) => "u32",
            Field::Bool(_) | Field::Flag(_) => "u8",
            Field::Text(_) => "text",
        }
    }

    /// Its name in tables and exports.
    pub fn exported_name(&self) -> &'static str {
        self.exported.map_or(self.name, |(name, _)| name)
    }

    /// Its heading in a workbook.
    pub fn heading(&self) -> &'static str {
        self.exported.map_or(self.name, |(_, heading)| heading)
    }

    /// Its name with `names` for what stands in angle brackets.
    pub fn name(&self, names: Names<'_>) -> String {
        named(self.name, names).into_owned()
    }

    /// The same quantity in a field of another plain value over other axes, under its name in tables.
    pub const fn over<U>(&self, axes: &'static [&'static str], field: Field<U>) -> Quantity<U> {
        let name = match self.exported {
            Some((name, _)) => name,
            None => self.name,
        };
        let Self { unit, long_name, note, is_later, .. } = *self;
        Quantity { name, axes, unit, long_name, note, exported: None, is_later, field }
    }

    /// Its name where arrays of all measures stand side by side: `u_pgv_m`, `flag_pgv`; the unit stays at the end.
    pub fn name_with(&self, key: &str) -> String {
        let name = self.exported_name();
        match name.strip_suffix("_m") {
            Some(stem) => format!("{stem}_{key}_m"),
            None => format!("{name}_{key}"),
        }
    }

    /// Its value at an index as a number; none of a text.
    pub fn number(&self, value: &T, index: usize) -> Option<f64> {
        match &self.field {
            Field::F64(place) => Some(*(place.get)(value, index)),
            Field::U32(place) => Some((*(place.get)(value, index)).into()),
            Field::Bool(place) => Some(f64::from(u8::from(*(place.get)(value, index)))),
            Field::Flag(place) => Some((place.get)(value, index).number().into()),
            Field::Text(_) => None,
            Field::Made(number) => Some(number(value, index)),
        }
    }

    /// Its values at these places as numbers; none of texts.
    pub fn numbers(&self, value: &T, places: Range<usize>) -> Vec<f64> {
        places.filter_map(|at| self.number(value, at)).collect()
    }

    /// Its axes; those with an empty name are not there.
    fn axes(&self, names: Names<'_>) -> Vec<String> {
        let axes = self.axes.iter().map(|axis| named(axis, names).into_owned());
        axes.filter(|axis| !axis.is_empty()).collect()
    }

    /// Its axes with their lengths.
    pub fn shape(&self, names: Names<'_>, lengths: Lengths<'_>) -> Vec<(String, usize)> {
        let length = |axis: &str| {
            let known = lengths.iter().find(|(name, _)| *name == axis);
            debug_assert!(known.is_some(), "{}: no length of {axis}", self.name);
            known.map_or(0, |(_, length)| *length)
        };
        self.axes(names).into_iter().map(|axis| (axis.clone(), length(&axis))).collect()
    }

    fn write(
        &self,
        writer: &mut LabelledWriter,
        path: &str,
        (names, lengths): (Names<'_>, Lengths<'_>),
        rows: &[Option<&T>],
    ) -> Result<(), LabelledError> {
        fn all<T, V: Clone>(rows: &[Option<&T>], each: usize, of: impl Fn(&T, usize) -> V, none: &V) -> Vec<V> {
            let value = |row: Option<&T>, at| row.map_or_else(|| none.clone(), |row| of(row, at));
            rows.iter().flat_map(|row| (0..each).map(|at| value(*row, at))).collect()
        }
        let shape = self.shape(names, lengths);
        let dims: &[&str] = &shape.iter().map(|(name, _)| name.as_ref()).collect::<Vec<_>>();
        let each = shape.iter().map(|(_, length)| length).product::<usize>() / rows.len().max(1);
        let (unit, long_name) = (&*named(self.unit, names), &*named(self.long_name, names));
        match &self.field {
            Field::F64(Place { get, .. }) => {
                let values = all(rows, each, |row, at| *get(row, at), &f64::NAN);
                writer.array(path, dims, &values, unit, long_name)
            }
            Field::Made(number) => writer.array(path, dims, &all(rows, each, number, &f64::NAN), unit, long_name),
            Field::U32(Place { get, .. }) => {
                writer.array(path, dims, &all(rows, each, |row, at| *get(row, at), &0), unit, long_name)
            }
            Field::Bool(Place { get, .. }) => {
                writer.array(path, dims, &all(rows, each, |row, at| u8::from(*get(row, at)), &0), unit, long_name)
            }
            Field::Flag(Place { get, .. }) => {
                let flags = all(rows, each, |row, at| get(row, at).number(), &NO_ORDINATE);
                writer.array(path, dims, &flags, unit, long_name)
            }
            Field::Text(Place { get, .. }) => {
                let texts = all(rows, each, |row, at| get(row, at).clone(), &String::new());
                writer.array_text(path, dims, &texts, long_name)
            }
        }
    }

    fn read(
        &self,
        file: &StoredResult,
        path: &str,
        shape: &[(String, usize)],
        value: &mut T,
    ) -> Result<(), ResultError> {
        fn fill<T, V>(value: &mut T, place: &Place<T, V>, values: impl IntoIterator<Item = V>) {
            for (index, own) in values.into_iter().enumerate() {
                *(place.get_mut)(value, index) = own;
            }
        }
        let reader = &file.reader;
        if self.is_later && !reader.exists(path) {
            return Ok(());
        }
        match &self.field {
            Field::F64(place) => fill(value, place, file.checked(path, reader.array::<f64>(path)?, shape)?),
            Field::U32(place) => fill(value, place, file.checked(path, reader.array::<u32>(path)?, shape)?),
            Field::Text(place) => fill(value, place, file.checked(path, reader.array::<String>(path)?, shape)?),
            Field::Bool(place) => {
                let numbers = file.checked(path, reader.array::<u8>(path)?, shape)?;
                fill(value, place, numbers.into_iter().map(|number| number == 1));
            }
            Field::Flag(place) => {
                let numbers = file.checked(path, reader.array::<u8>(path)?, shape)?;
                if let Some(unknown) = numbers.iter().find(|&&number| OrdinateFlag::from_number(number).is_none()) {
                    return Err(file.damaged(format!("{path} has the unknown flag {unknown}")));
                }
                fill(value, place, numbers.into_iter().filter_map(OrdinateFlag::from_number));
            }
            Field::Made(_) => {}
        }
        Ok(())
    }
}

impl<const N: usize, V: Number> Group<Array<N, V>> {
    /// Writes the `values` of its only array, without a copy.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write_array(
        &self,
        writer: &mut LabelledWriter,
        names: Names<'_>,
        values: &[V],
    ) -> Result<(), LabelledError> {
        self.with_only(names, |path, dims, unit, long_name| writer.array(path, dims, values, unit, long_name))
    }
}

impl<T> Group<T> {
    /// The group of all measures: `/urs` of `/urs/<im>`.
    pub fn root(&self) -> &'static str {
        self.path.split_once("/<").map_or(self.path, |(root, _)| root)
    }

    /// Its path with names for what stands in angle brackets.
    pub fn group(&self, names: Names<'_>) -> String {
        named(self.path, names).into_owned()
    }

    /// The group of one measure.
    pub fn for_measure(&self, measure: IntensityMeasure) -> String {
        self.group(&measure_names(measure))
    }

    /// Those of its arrays that tables and exports have.
    pub fn exported(&self) -> impl Iterator<Item = &'static Quantity<T>> {
        self.quantities.iter().filter(|quantity| quantity.exported.is_some())
    }

    /// What `write` makes of path, axes, unit and long name of the only array.
    fn with_only<R>(&self, names: Names<'_>, write: impl FnOnce(&str, &[&str], &str, &str) -> R) -> R {
        debug_assert_eq!(self.quantities.len(), 1, "the arrays of {}", self.path);
        self.with(&self.quantities[0], names, write)
    }

    /// What `write` makes of path, axes, unit and long name of an array.
    fn with<R>(&self, own: &Quantity<T>, names: Names<'_>, write: impl FnOnce(&str, &[&str], &str, &str) -> R) -> R {
        let axes = own.axes(names);
        let dims: Vec<&str> = axes.iter().map(AsRef::as_ref).collect();
        write(&self.path(own, names), &dims, &named(own.unit, names), &named(own.long_name, names))
    }

    /// The path of an array.
    pub fn path(&self, quantity: &Quantity<T>, names: Names<'_>) -> String {
        named(&format!("{}/{}", self.path.trim_end_matches('/'), quantity.name), names).into_owned()
    }

    /// Begins an array to which rows are appended.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn grow<V: Number>(
        &self,
        quantity: &Quantity<T>,
        writer: &mut LabelledWriter,
        names: Names<'_>,
    ) -> Result<GrowingArray<V>, LabelledError> {
        self.with(quantity, names, |path, dims, unit, long_name| writer.grow(path, dims, unit, long_name))
    }

    /// The path of the first of its arrays that results of every version have.
    pub fn first_path(&self, names: Names<'_>) -> String {
        let first = self.quantities.iter().find(|own| !own.is_later);
        self.path(first.unwrap_or(&self.quantities[0]), names)
    }

    /// Whether `file` has that array.
    pub(super) fn is_in(&self, file: &StoredResult, names: Names<'_>) -> bool {
        file.reader.exists(&self.first_path(names))
    }

    /// The array `name`.
    fn quantity(&self, file: &StoredResult, name: &str) -> Result<&'static Quantity<T>, ResultError> {
        let named = self.quantities.iter().find(|own| own.name == name);
        named.ok_or_else(|| file.fail(format!("{} has no array {name}", self.path)))
    }

    /// Writes every array of `value`.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write(
        &self,
        writer: &mut LabelledWriter,
        names: Names<'_>,
        lengths: Lengths<'_>,
        value: &T,
    ) -> Result<(), LabelledError> {
        self.write_rows(writer, names, lengths, [Some(value)])
    }

    /// Writes every array, each value of `rows` being a row of them along their first axes; a missing one is a row of
    /// NaN, of 0 for counts, of empty texts.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write_rows<'a>(
        &self,
        writer: &mut LabelledWriter,
        names: Names<'_>,
        lengths: Lengths<'_>,
        rows: impl IntoIterator<Item = Option<&'a T>>,
    ) -> Result<(), LabelledError> {
        let rows: Vec<_> = rows.into_iter().collect();
        self.quantities
            .iter()
            .try_for_each(|quantity| quantity.write(writer, &self.path(quantity, names), (names, lengths), &rows))
    }

    /// Reads the array `name`, of floats.
    pub(super) fn read_array<const N: usize>(
        &self,
        name: &str,
        file: &StoredResult,
        names: Names<'_>,
        lengths: [(&str, usize); N],
    ) -> Result<Array<N>, ResultError> {
        file.array(&self.path(self.quantity(file, name)?, names), lengths)
    }

    /// The values of the array `name`, of floats, whatever its axes are.
    pub(super) fn read_floats(
        &self,
        name: &str,
        file: &StoredResult,
        names: Names<'_>,
        lengths: Lengths<'_>,
    ) -> Result<Vec<f64>, ResultError> {
        let quantity = self.quantity(file, name)?;
        let (path, shape) = (self.path(quantity, names), quantity.shape(names, lengths));
        file.checked(&path, file.reader.array::<f64>(&path)?, &shape)
    }

    /// Reads every array into `value`, which has a place for every value.
    pub(super) fn read(
        &self,
        file: &StoredResult,
        names: Names<'_>,
        lengths: Lengths<'_>,
        value: &mut T,
    ) -> Result<(), ResultError> {
        self.quantities.iter().try_for_each(|quantity| {
            quantity.read(file, &self.path(quantity, names), &quantity.shape(names, lengths), value)
        })
    }

    /// Whether every array holds exactly the values of `rows`, one a row.
    pub(super) fn holds(&self, file: &StoredResult, names: Names<'_>, rows: &[T]) -> Result<bool, ResultError> {
        for quantity in self.quantities {
            let path = self.path(quantity, names);
            let (reader, row) = (&file.reader, rows.iter());
            let same = match &quantity.field {
                Field::F64(Place { get, .. }) => {
                    let kept = reader.array::<f64>(&path)?.values;
                    kept.iter().map(|value| value.to_bits()).eq(row.map(|row| get(row, 0).to_bits()))
                }
                Field::U32(Place { get, .. }) => {
                    reader.array::<u32>(&path)?.values.iter().eq(row.map(|row| get(row, 0)))
                }
                Field::Text(Place { get, .. }) => {
                    reader.array::<String>(&path)?.values.iter().eq(row.map(|row| get(row, 0)))
                }
                Field::Bool(_) | Field::Flag(_) | Field::Made(_) => false,
            };
            if !same {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests;
