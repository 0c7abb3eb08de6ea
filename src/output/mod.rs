//! Tables, files and pictures from plain data, without dependence on simulations.
//! A canvas collects the shapes of a picture, and painters write the canvas to a file.

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod animation;
mod axis;
mod bars;
mod base64;
mod canvas;
mod chart;
mod colour;
mod colour_bar;
mod csv;
mod curve;
mod data_table;
mod error;
mod field;
mod figure;
mod files;
mod fonts;
mod frame;
mod hatching;
mod heat_map;
mod legend;
mod level_map;
mod link;
mod marker;
mod mechanism_outline;
mod motion;
mod npz;
mod number;
mod page;
#[cfg(feature = "parquet")]
mod parquet;
mod plane;
mod png;
mod printable;
mod records;
mod strips;
mod stroke;
mod svg;
mod symbol;
mod table;
mod terminal;
pub mod viewer;
mod vtk;
mod width;

#[cfg(test)]
mod samples;

pub(crate) use animation::Animation;
pub(crate) use axis::AxisScale;
pub(crate) use bars::BarChart;
pub(crate) use canvas::Point;
pub(crate) use chart::{LineChart, Series, SeriesColour};
pub(crate) use csv::{CsvTable, csv_cell};
pub(crate) use data_table::{DataColumn, DataTable, DataValues, TableHeading};
pub(crate) use error::OutputError;
pub(crate) use field::FieldPicture;
pub(crate) use figure::{Figure, PictureKind};
pub(crate) use files::write_atomic;
pub(crate) use frame::Margins;
pub(crate) use heat_map::{HeatCell, HeatMap};
pub(crate) use level_map::{LevelAxis, LevelMap};
pub(crate) use marker::Marker;
pub(crate) use mechanism_outline::MechanismOutline;
pub(crate) use motion::{MotionFrame, MotionPicture};
pub(crate) use npz::{NpzArchive, NpzArray};
pub(crate) use number::{format_number, scientific, significant};
pub(crate) use page::{Page, Panel};
pub(crate) use plane::AxisLimits;
pub(crate) use printable::{printable, printable_in_colours, printable_line};
pub(crate) use records::CsvRecords;
pub(crate) use strips::{BeamSide, BeamStrip, StripPicture};
pub(crate) use stroke::Stroke;
pub(crate) use symbol::{PlacedSymbol, Symbol};
pub(crate) use table::{Cell, TextTable};
pub use terminal::{Colours, Glyphs, TerminalStyle};
pub(crate) use terminal::{ConfigurationPicture, PictureMark};
pub(crate) use vtk::{VtkCell, VtkField, VtkGrid, VtkValues, vtk_collection};
pub(crate) use width::{beginning, columns, columns_of, cut, padded};
