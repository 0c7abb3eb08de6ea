//! Tapered sections.

use rhai::{Array, Dynamic};

use super::sections::SECTION;
use crate::beams::{BeamError, Section, SectionVariation, Solid};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::array;
use crate::script::bindings::parameter::number;
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, method};
use crate::script::handles::section::SectionHandle;
use crate::script::messages::error::{CallPart, ScriptError};

pub const TABLE: BindingTable = BindingTable {
    name: "tapers",
    doc: "Sections that vary along a beam, for example for blades, whips and fly rods.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[
        function("taper", &[array("places")], taper)
            .returns(Returns::object(SECTION))
            .summary("Creates a section that varies along a beam, interpolated between sections at \
                given places: [[0, thick], [1, thin]].")
            .doc(
                "Places are fractions of the undeformed length and increase from 0 to 1. If all \
                sections have a material and the same kind of shape, dimensions and material \
                are interpolated linearly: a wedge has linear height and cubic EI. Otherwise \
                EA, GA, EI, rho_A and rho_I are interpolated linearly. All sections of a taper \
                must have the same damping.",
            )
            .example(
                "fn solid(height) { section(#{ E: 12e9, nu: 0.3, density: 700, shape: \"rectangle\", width: 0.02, height: height }) }\n\
                 let blade = taper([[0, solid(0.01)], [1, solid(0.002)]]);\n\
                 check_close(blade.at(0.5).EI, 12e9 * 0.02 * 0.006^3 / 12, 1e-9);\n\
                 let scene = new_scene(\"blade\");\nlet beam = scene.beam(#{ axis: line([0, 0], [1, 0]), section: blade });\nscene.clamp(beam.start);",
            )
            .with_related(&["section", "beam"]),
        method(SECTION, "at", &[number("part").between(0.0, 1.0).doc("fraction of the length, from the start")], |call| {
            let handle = call.receiver::<SectionHandle>()?;
            let section = handle.variation.at(call.number("part")?);
            Ok(Dynamic::from(SectionHandle { variation: section.into(), solid: None, ..handle }))
        })
        .returns(Returns::object(SECTION))
        .summary("Returns the section of a taper at a fraction of the length.")
        .example("fn of(bending) { section(#{ EA: 1e4, GA: 1e4, EI: bending, rho_A: 1, rho_I: 1 }) }\ncheck(taper([[0, of(4)], [1, of(2)]]).at(0.25).EI == 3.5);")
        .with_related(&["taper"]),
    ],
};

fn taper(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let mut all: Vec<(f64, SectionHandle)> = Vec::new();
    for (index, given) in call.array("places")?.into_iter().enumerate() {
        all.push(place(call, index, given)?);
    }
    let relaxation = all.first().and_then(|(_, section)| section.relaxation);
    if let Some((place, _)) = all.iter().find(|(_, section)| section.relaxation != relaxation) {
        let message =
            format!("the damping of the section at {place} differs from that at the start");
        let hint = "give the sections of a taper the same damping";
        return Err(call.error(message).hint(hint).at(CallPart::Argument(0)));
    }
    let variation = variation(&all).validated().map_err(|error| match error {
        BeamError::SectionValue { .. } => ScriptError::from(error),
        _ => ScriptError::from(error).hint("write taper([[0, thick], [1, thin]])"),
    });
    let variation = variation.map_err(|error| error.at(CallPart::Argument(0)))?;
    Ok(Dynamic::from(SectionHandle { variation, solid: None, relaxation }))
}

/// Interpolates the dimensions of solids with the same type of shape, otherwise the stiffnesses and inertias.
fn variation(all: &[(f64, SectionHandle)]) -> SectionVariation {
    let solids: Option<Vec<(f64, Solid)>> =
        all.iter().map(|(place, section)| Some((*place, section.solid?))).collect();
    let alike = |all: &Vec<(f64, Solid)>| {
        all.windows(2).all(|pair| pair[0].1.has_same_shape_as(&pair[1].1))
    };
    match solids.filter(alike) {
        Some(solids) => SectionVariation::Dimensions(solids),
        None => {
            let section = |section: &SectionHandle| -> Section { section.variation.at(0.0) };
            SectionVariation::Numbers(all.iter().map(|(place, of)| (*place, section(of))).collect())
        }
    }
}

fn place(call: &Call, index: usize, given: Dynamic) -> Result<(f64, SectionHandle), ScriptError> {
    let read = |given: Dynamic| {
        let pair = given.try_cast::<Array>()?;
        let [place, section] = <[Dynamic; 2]>::try_from(pair).ok()?;
        let place = place.as_float().or_else(|_| place.as_int().map(|whole| whole as f64)).ok()?;
        let section = section.try_cast::<SectionHandle>()?;
        matches!(section.variation, SectionVariation::Uniform(_)).then_some((place, section))
    };
    read(given).ok_or_else(|| {
        let message = format!("place {} is not a fraction of the length with a section", index + 1);
        call.error(message)
            .hint("write [0.5, section], where 0.5 is the middle")
            .at(CallPart::Argument(0))
    })
}
