//! Pictures and tables as files of the output folder.

use std::path::Path;

use rhai::Dynamic;

use crate::output::{CsvTable, Panel, PictureKind};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, text};
use crate::script::messages::error::ScriptError;

/// The name of a file.
pub const FILE: Parameter = text("file").doc("its name in the output folder");

/// Writes a picture into the output folder, in the format that the ending of its name asks for; gives nothing to the script.
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

/// Writes a table into the output folder, if the name of its file ends as it should; gives nothing to the script.
pub fn write_csv(call: &Call, table: CsvTable) -> Result<Dynamic, ScriptError> {
    let file = call.text("file")?;
    if !file.ends_with(".csv") {
        return Err(call.error(format!("\"{file}\" does not end in .csv")));
    }
    call.context().write_file(&file, table.to_text()?.as_bytes())?;
    Ok(Dynamic::UNIT)
}
