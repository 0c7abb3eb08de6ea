//! Tables, files and pictures from plain data. This module knows nothing about simulations.
//!
//! ```text
//! chart, heat_map, level_map, bars, motion, strips, field → page → scenery → plane, symbol → frame, hatching, legend, colour_bar → axis, curve, stroke, marker → canvas → figure
//! → svg, png → files
//! chart, heat_map → terminal → axis, curve
//! motion → animation → figure
//! viewer (a page for browsers) → canvas, colour
//! ```
//!
//! Pictures look the same on every machine: text is drawn from an embedded font, and equal data gives equal bytes.

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

pub use animation::Animation;
pub use axis::{AxisScale, DEFAULT_FLOOR};
pub use bars::BarChart;
pub use canvas::{Align, Area, Canvas, Point, Shape, Text, TextDirection};
pub use chart::{LineChart, Series, SeriesColour, SeriesEmphasis};
pub use colour::Colour;
pub use csv::{CsvTable, csv_cell};
pub use data_table::{DataColumn, DataTable, DataValues, TableHeading};
pub use error::OutputError;
pub use field::FieldPicture;
pub use figure::{Figure, PictureKind};
pub use files::write_atomic;
pub use frame::Margins;
pub use heat_map::{HeatCell, HeatMap};
pub use level_map::{LevelAxis, LevelMap};
pub use marker::Marker;
pub use mechanism_outline::MechanismOutline;
pub use motion::{MotionFrame, MotionPicture};
pub use npz::{NpzArchive, NpzArray};
pub use number::{format_number, scientific, significant};
pub use page::{Page, Panel};
pub use plane::AxisLimits;
pub use printable::{printable, printable_in_colours, printable_line};
pub use records::CsvRecords;
pub use strips::{BeamSide, BeamStrip, StripPicture};
pub use stroke::Stroke;
pub use symbol::{PlacedSymbol, Symbol};
pub use table::{Cell, TextTable};
pub use terminal::{Colours, ConfigurationPicture, Glyphs, PictureMark, TerminalStyle};
pub use vtk::{VtkCell, VtkField, VtkGrid, VtkValues, vtk_collection};
pub use width::{beginning, columns, columns_of, cut, padded};
