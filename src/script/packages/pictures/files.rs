//! Writing of pictures and tables to the output folder.

use std::path::Path;

use rhai::Dynamic;

use crate::output::{CsvTable, Panel, PictureKind};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, text};
use crate::script::messages::error::ScriptError;

pub const FILE: Parameter = text("file").doc("file name in the output folder");

pub fn write_picture(call: &Call, picture: &dyn Panel) -> Result<Dynamic, ScriptError> {
    let file = call.text("file")?;
    let kind = PictureKind::of(Path::new(file.as_str()))?;
    let figure = picture.figure()?;
    let bytes = match kind {
        PictureKind::Svg => figure.to_svg()?.into_bytes(),
        PictureKind::Png => figure.to_png()?,
    };
    call.context().write_file(&file, &bytes)?;
    Ok(Dynamic::UNIT)
}

pub fn write_csv(call: &Call, table: CsvTable) -> Result<Dynamic, ScriptError> {
    let file = call.text("file")?;
    if !file.ends_with(".csv") {
        return Err(call.error(format!("\"{file}\" does not end in .csv")));
    }
    call.context().write_file_by(&file, |file| table.write(file))?;
    Ok(Dynamic::UNIT)
}
