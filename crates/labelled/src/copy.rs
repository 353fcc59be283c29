//! Carrying a file over into a new one: how an existing file is extended.
//!
//! A file is never changed in place: a failure, or a full disk, would leave neither the old nor the new one. It is
//! written again, with what is added, and then takes the place of the old one at once.

use std::collections::BTreeSet;

use hdf5::plist::ObjectCopy;
use hdf5::types::{FloatSize, IntSize, TypeDescriptor};
use hdf5::{Container, Location, LocationType};

use super::AXES;
use super::attribute::{self, AttributeValue};
use super::checksum::CHECKSUM;
use super::dimension_scale::{self, RESERVED};
use super::error::LabelledError;
use super::reader::LabelledReader;
use super::writer::LabelledWriter;

/// Attributes of an array that have arguments of their own.
const DESCRIPTIONS: [&str; 3] = ["units", "long_name", CHECKSUM];

impl LabelledWriter {
    /// Carries over every axis, array and attribute of `reader` but the axes and groups named in `left_out`, e.g.
    /// `/bootstrap` or `/axes/replicate`.
    ///
    /// One array is in memory at a time. An array that is not as it was written is refused, so that damage never gets a
    /// new checksum.
    ///
    /// # Errors
    /// Whatever keeps the one file from being read or the other from being written; an array over an axis left out.
    pub fn carry_over(&mut self, reader: &LabelledReader, left_out: &[&str]) -> Result<(), LabelledError> {
        self.carry_attributes(reader, "/", &[])?;
        for axis in reader.axes()? {
            let path = format!("{AXES}/{axis}");
            if !left_out.contains(&path.as_str()) {
                self.carry_axis(reader, &axis, &path)?;
            }
        }
        self.carry_group(reader, "", left_out)
    }

    /// Carries over the `groups` of `reader`, e.g. `/influence`, with those of their axes that this file lacks; a group
    /// that is not there is skipped.
    ///
    /// # Errors
    /// As [`Self::carry_over`].
    pub fn carry_groups(&mut self, reader: &LabelledReader, groups: &[&str]) -> Result<(), LabelledError> {
        for group in groups.iter().filter(|group| reader.exists(group)) {
            for axis in reader.axes_below(group)? {
                if !self.axes.contains_key(&axis) {
                    self.carry_axis(reader, &axis, &format!("{AXES}/{axis}"))?;
                }
            }
            self.group(group)?;
            self.carry_attributes(reader, group, &[])?;
            self.carry_group(reader, group, &[])?;
        }
        Ok(())
    }

    fn carry_group(&mut self, reader: &LabelledReader, group: &str, left_out: &[&str]) -> Result<(), LabelledError> {
        for name in reader.children(if group.is_empty() { "/" } else { group })? {
            let path = format!("{group}/{name}");
            if path == AXES || left_out.contains(&path.as_str()) {
                continue;
            }
            if reader.is_group(&path) {
                self.group(&path)?;
                self.carry_attributes(reader, &path, &[])?;
                self.carry_group(reader, &path, left_out)?;
            } else {
                self.carry_array(reader, &path)?;
            }
        }
        Ok(())
    }

    fn carry_axis(&mut self, reader: &LabelledReader, axis: &str, path: &str) -> Result<(), LabelledError> {
        reader.require_sound(path)?;
        let long_name = reader.attribute::<String>(path, "long_name")?;
        match reader.kind(path)? {
            Kind::Text => self.axis_text(axis, &reader.axis::<String>(axis)?, &long_name)?,
            Kind::F64 | Kind::F32 => self.axis::<f64>(axis, &reader.axis(axis)?, &reader.unit(path)?, &long_name)?,
            Kind::U32 | Kind::U8 => self.axis::<u32>(axis, &reader.axis(axis)?, &reader.unit(path)?, &long_name)?,
            Kind::I64 | Kind::U64 => self.axis::<i64>(axis, &reader.axis(axis)?, &reader.unit(path)?, &long_name)?,
        }
        self.carry_attributes(reader, path, &DESCRIPTIONS)
    }

    fn carry_array(&mut self, reader: &LabelledReader, path: &str) -> Result<(), LabelledError> {
        reader.require_sound(path)?;
        let long_name = reader.attribute::<String>(path, "long_name")?;
        match reader.kind(path)? {
            Kind::Text => {
                let array = reader.array::<String>(path)?;
                let dims: Vec<&str> = array.dims.iter().map(String::as_str).collect();
                self.array_text(path, &dims, &array.values, &long_name)?;
            }
            Kind::F64 | Kind::F32 | Kind::U32 | Kind::U8 => self.carry_numbers(reader, path, &long_name)?,
            Kind::I64 | Kind::U64 => return Err(reader.unknown(path)),
        }
        self.carry_attributes(reader, path, &DESCRIPTIONS)
    }

    /// Carries over a sound array of numbers as it is compressed.
    fn carry_numbers(&mut self, reader: &LabelledReader, path: &str, long_name: &str) -> Result<(), LabelledError> {
        let unit = reader.unit(path)?;
        let checksum = reader.attribute::<String>(path, CHECKSUM).or_else(|_| reader.checksum(path))?;
        let source = reader.dataset(path)?;
        let dims = reader.check(dimension_scale::names(&reader.file, &source), path)?.unwrap_or_default();
        let dims: Vec<&str> = dims.iter().map(String::as_str).collect();
        let shape = self.shape(path, &dims)?;
        if shape != source.shape() {
            return Err(self.misuse(path, format!("{:?} values for the shape {shape:?} of {dims:?}", source.shape())));
        }
        self.prepare(path, &dims)?;
        let copy = || {
            // references to axes hold in their own file alone
            let bare = ObjectCopy::build().copy_without_attr(true).finish()?;
            source.copy_to_with_props(&self.file, path, Some(&bare), None)?;
            let dataset = self.file.dataset(path)?;
            for (name, value) in DESCRIPTIONS.into_iter().zip([unit.as_str(), long_name, &checksum]) {
                attribute::write(&dataset, name, &value.into())?;
            }
            dataset.flush()?;
            Ok(dataset)
        };
        let dataset = self.check(copy(), "write", path)?;
        self.note_chunks(path, &dataset);
        self.attach(path, &dims, &dataset)
    }

    fn carry_attributes(
        &mut self,
        reader: &LabelledReader,
        object: &str,
        left_out: &[&str],
    ) -> Result<(), LabelledError> {
        for (name, value) in reader.own_attributes(object)? {
            if !left_out.contains(&name.as_str()) {
                self.attribute(object, &name, value)?;
            }
        }
        Ok(())
    }
}

/// What an array or attribute holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Text,
    F64,
    F32,
    U32,
    U8,
    I64,
    U64,
}

impl LabelledReader {
    /// Names of all axes.
    fn axes(&self) -> Result<Vec<String>, LabelledError> {
        let names = self.file.group(AXES).and_then(|group| group.member_names());
        self.check(names, AXES)
    }

    /// Names of the axes of the arrays in `group` and in the groups below it.
    fn axes_below(&self, group: &str) -> Result<BTreeSet<String>, LabelledError> {
        let mut axes = BTreeSet::new();
        for name in self.children(group)? {
            let path = format!("{group}/{name}");
            if self.is_group(&path) {
                axes.extend(self.axes_below(&path)?);
            } else {
                let dataset = self.check(self.file.dataset(&path), &path)?;
                axes.extend(self.check(dimension_scale::names(&self.file, &dataset), &path)?.unwrap_or_default());
            }
        }
        Ok(axes)
    }

    pub(super) fn is_group(&self, path: &str) -> bool {
        matches!(self.file.loc_type_by_name(path), Ok(LocationType::Group))
    }

    fn unit(&self, path: &str) -> Result<String, LabelledError> {
        self.attribute::<String>(path, "units")
    }

    pub(super) fn kind(&self, path: &str) -> Result<Kind, LabelledError> {
        let dataset = self.check(self.file.dataset(path), path)?;
        self.kind_of(&dataset, path)
    }

    fn kind_of(&self, container: &Container, object: &str) -> Result<Kind, LabelledError> {
        match self.check(container.dtype().and_then(|datatype| datatype.to_descriptor()), object)? {
            TypeDescriptor::Float(FloatSize::U8) => Ok(Kind::F64),
            TypeDescriptor::Float(FloatSize::U4) => Ok(Kind::F32),
            TypeDescriptor::Unsigned(IntSize::U4) => Ok(Kind::U32),
            TypeDescriptor::Unsigned(IntSize::U1) => Ok(Kind::U8),
            TypeDescriptor::Unsigned(IntSize::U8) => Ok(Kind::U64),
            TypeDescriptor::Integer(IntSize::U8) => Ok(Kind::I64),
            TypeDescriptor::VarLenUnicode => Ok(Kind::Text),
            _ => Err(self.unknown(object)),
        }
    }

    fn unknown(&self, object: &str) -> LabelledError {
        self.wrong(object, "of a type that this program does not write".into(), "a result as this program writes it")
    }

    /// The attributes of a group or array that are its user's.
    fn own_attributes(&self, object: &str) -> Result<Vec<(String, AttributeValue)>, LabelledError> {
        let location: Location = if self.is_group(object) {
            let group = self.check(self.file.group(object), object)?;
            Location::clone(&group)
        } else {
            let dataset = self.check(self.file.dataset(object), object)?;
            Location::clone(&dataset)
        };
        let mut attributes = Vec::new();
        for name in self.check(location.attr_names(), object)? {
            if RESERVED.contains(&name.as_str()) {
                continue;
            }
            let attribute = self.check(location.attr(&name), object)?;
            let single = attribute.ndim() == 0;
            let value = match self.kind_of(&attribute, object)? {
                Kind::Text if single => self.attribute::<String>(object, &name)?.into(),
                Kind::Text => self.attributes::<String>(object, &name)?.into(),
                Kind::F64 if single => self.attribute::<f64>(object, &name)?.into(),
                Kind::F64 => self.attributes::<f64>(object, &name)?.into(),
                Kind::I64 if single => self.attribute::<i64>(object, &name)?.into(),
                Kind::I64 => self.attributes::<i64>(object, &name)?.into(),
                Kind::U64 => self.attribute::<u64>(object, &name)?.into(),
                Kind::F32 | Kind::U32 | Kind::U8 => return Err(self.unknown(object)),
            };
            attributes.push((name, value));
        }
        Ok(attributes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_carried_over_is_the_same_file_but_for_what_is_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let (old, new, again) = (folder.path().join("a.h5"), folder.path().join("b.h5"), folder.path().join("c.h5"));
        let mut writer = LabelledWriter::create(&old).unwrap();
        writer.attribute("/", "program", "uplift").unwrap();
        writer.attribute("/", "seed", 7_u64).unwrap();
        writer.attribute("/", "years", 50.0).unwrap();
        writer.attribute("/", "levels", vec![1_i64, 2]).unwrap();
        writer.attribute("/", "names", vec!["å".to_owned()]).unwrap();
        writer.axis_text("site", &["Focşani".to_owned(), "Perugia".to_owned()], "site").unwrap();
        writer.axis::<u32>("size", &[20, 40], "1", "records").unwrap();
        writer.array("/urs/pgv/u_m", &["site"], &[0.1, f64::INFINITY], "m", "displacement").unwrap();
        writer.attribute("/urs/pgv", "note", "a group").unwrap();
        writer.attribute("/urs/pgv/u_m", "note", "an array").unwrap();
        writer.array::<u8>("/urs/pgv/flag", &["site"], &[0, 2], "1", "flag").unwrap();
        writer.array_text("/sites/country", &["site"], &["RO".to_owned(), "IT".to_owned()], "country").unwrap();
        writer.array("/bootstrap/u_m", &["site", "size"], &[1.0; 4], "m", "band").unwrap();
        writer.finish().unwrap();

        let carry = |from: &std::path::Path, to: &std::path::Path, left_out: &[&str]| {
            let reader = LabelledReader::open(from).unwrap();
            let mut writer = LabelledWriter::create(to).unwrap();
            writer.carry_over(&reader, left_out).unwrap();
            writer.finish().unwrap();
        };
        carry(&old, &new, &["/bootstrap", "/axes/size"]);
        let reader = LabelledReader::open(&new).unwrap();
        assert!(!reader.exists("/bootstrap") && !reader.exists("/axes/size"));
        assert_eq!(reader.array::<f64>("/urs/pgv/u_m").unwrap().values, [0.1, f64::INFINITY]);
        assert_eq!(reader.array::<String>("/sites/country").unwrap().values, ["RO", "IT"]);
        assert_eq!(reader.attribute::<String>("/urs/pgv/u_m", "note").unwrap(), "an array");
        assert_eq!(reader.attribute::<String>("/urs/pgv", "note").unwrap(), "a group");
        assert_eq!(reader.attribute::<u64>("/", "seed").unwrap(), 7);
        assert_eq!(reader.attributes::<i64>("/", "levels").unwrap(), [1, 2]);
        assert_eq!(reader.attributes::<String>("/", "names").unwrap(), ["å"]);
        drop(reader);
        let only = folder.path().join("d.h5");
        let mut writer = LabelledWriter::create(&only).unwrap();
        writer.axis_text("site", &["Focşani".to_owned(), "Perugia".to_owned()], "site").unwrap();
        writer.carry_groups(&LabelledReader::open(&old).unwrap(), &["/bootstrap", "/urs", "/none"]).unwrap();
        writer.finish().unwrap();
        let reader = LabelledReader::open(&only).unwrap();
        assert_eq!(reader.children("/").unwrap(), ["axes", "bootstrap", "urs"]);
        assert_eq!(reader.array::<f64>("/bootstrap/u_m").unwrap().dims, ["site", "size"]);
        assert_eq!(reader.axis::<u32>("size").unwrap(), [20, 40]);
        assert_eq!(reader.attribute::<String>("/urs/pgv", "note").unwrap(), "a group");
        drop(reader);
        // once in the order of a copy, a file is carried over byte for byte
        carry(&new, &again, &[]);
        assert_eq!(std::fs::read(&new).unwrap(), std::fs::read(&again).unwrap());
    }
}
