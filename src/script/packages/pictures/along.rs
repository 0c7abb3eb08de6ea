//! Pictures of section forces and strains along beams.

use rhai::{Array, Dynamic};

use super::files::{FILE, write_picture};
use super::options::{SYMBOLS, X_LIMITS, Y_LIMITS, limits, symbols};
use crate::output::Page;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Kind;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{Parameter, array, choice, either, options, text};
use crate::script::bindings::table::{BindingTable, function};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::equilibrium::EquilibriumHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::suggest::nearest;
use crate::script::packages::equilibria::EQUILIBRIUM;
use crate::script::packages::simulations::{SIMULATION, SPINNING};
use crate::script::presentation::along::SectionForceProfile;
use crate::script::presentation::quantities::{BeamQuantity, NAMES};

pub const TABLE: BindingTable = BindingTable {
    name: "pictures along beams",
    doc: "Quantities along beams, of a simulation at the present time or of an equilibrium: N \
        (axial force, positive in tension), Q (shear force), M (bending moment), axial_strain, \
        shear_strain, curvature, strain_energy (per length) and speed.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("plot_along", &[OF, QUANTITIES, FILE, options("options", ALONG).optional()], plot_along)
            .summary("Plots a quantity along beams: as strips on the beams in the present \
                configuration, and as a chart over their arc length.")
            .doc(
                "Several quantities are plotted below each other. Positive values are on the \
                left of a beam, seen from its start; positive values of M and curvature are on \
                the right, the tension side. The largest and the smallest value of each beam \
                are written beside it. For past times go back with `sim.back`, or plot at a \
                time with `sim.at`. At the prompt `:along M` plots the chart.",
            )
            .example(
                "sim.run_to(1);\nplot_along(sim, \"M\", \"moment.svg\");\n\
                 plot_along(sim, [\"N\", \"Q\", \"M\"], \"forces.svg\", #{ beams: [rod], title: \"at the end\" });",
            )
            .with_related(&["plot_field", "plot", "plot_history", "plot_motion"]),
        function("plot_field", &[OF, QUANTITY, FILE, options("options", FIELD).optional()], plot_field)
            .summary("Plots beams coloured by the magnitude of a quantity; larger magnitudes have \
                darker and wider lines.")
            .doc("A colour bar shows the values; the place and the value of the largest \
                magnitude are marked.")
            .example("sim.run_to(1);\nplot_field(sim, \"strain_energy\", \"energy.svg\");\nplot_field(sim, \"speed\", \"speed.png\");")
            .with_related(&["plot_along", "plot_motion"]),
    ],
};

const OF: Parameter = either("of", &[Kind::Object(SIMULATION), Kind::Object(EQUILIBRIUM)])
    .doc("a simulation at the present time, or an equilibrium");
const QUANTITIES: Parameter = either("quantity", &[Kind::Choice(NAMES), Kind::Array])
    .doc("name of a quantity, or an array of names");
const QUANTITY: Parameter = choice("quantity", NAMES);
const BEAMS: Parameter = array("beams").doc("beams to be plotted; default: all").optional();
const TITLE: Parameter = text("title").doc("title; default: the name of the simulation").optional();
const ALONG: &[Parameter] = &[TITLE, BEAMS, SYMBOLS];
const FIELD: &[Parameter] = &[TITLE, BEAMS, SYMBOLS, X_LIMITS, Y_LIMITS];

fn plot_along(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options_or_defaults("options")?;
    let quantities = quantities(call)?;
    let inside = inside(call, &options)?;
    let page = match quantities.len() {
        1 => Page::column(),
        _ => Page::grid(2),
    };
    let page = quantities.into_iter().fold(page, |page, quantity| {
        page.panel(inside.strips(quantity)).panel(inside.chart(quantity))
    });
    write_picture(call, &page)
}

fn plot_field(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options_or_defaults("options")?;
    let name = call.text("quantity")?;
    let inside = inside(call, &options)?;
    let picture = inside
        .field(quantity(call, &name)?)
        .limits(limits(&options).map_err(|wrong| wrong.in_call(call))?);
    write_picture(call, &picture)
}

fn quantity(call: &Call, name: &str) -> Result<&'static BeamQuantity, ScriptError> {
    BeamQuantity::named(name).ok_or_else(|| {
        let meant = nearest(name, NAMES.iter().copied());
        let meant = meant.map(|name| format!("did you mean \"{name}\"? ")).unwrap_or_default();
        call.error(format!("there is no quantity \"{name}\" along beams"))
            .hint(format!("{meant}quantities: {}", NAMES.join(", ")))
            .at(CallPart::Argument(1))
    })
}

fn quantities(call: &Call) -> Result<Vec<&'static BeamQuantity>, ScriptError> {
    if let Some(names) = call.get_if::<Array>("quantity") {
        if names.is_empty() || names.len() > NAMES.len() {
            let message = format!("{} quantities are given", names.len());
            let hint = format!("give one or several of {}", NAMES.join(", "));
            return Err(call.error(message).hint(hint).at(CallPart::Argument(1)));
        }
        return names.iter().map(|name| quantity(call, &name.to_string())).collect();
    }
    Ok(vec![quantity(call, &call.text("quantity")?)?])
}

fn inside(call: &Call, options: &Options) -> Result<SectionForceProfile, ScriptError> {
    let mut inside = match call.get_if::<EquilibriumHandle>("of") {
        Some(handle) => {
            let rest = handle.equilibrium();
            let beams = beams(call, options, handle.scene(), rest.scene().beams.len())?;
            SectionForceProfile::of_equilibrium(&rest, &beams)?
        }
        None => {
            let handle = call.get::<SimulationHandle>("of")?;
            let simulation = handle.simulation();
            let count = simulation.scene().beams.len();
            let beams = beams(call, options, handle.scene(), count)?;
            let mut inside = SectionForceProfile::of_simulation(&simulation, &beams)?;
            inside.title = handle.name().to_owned();
            inside
        }
    };
    if let Some(title) = options.optional_text("title")? {
        inside.title = title.to_string();
    }
    Ok(inside.with_symbols(symbols(options)))
}

fn beams(
    call: &Call,
    options: &Options,
    scene: &SceneHandle,
    count: usize,
) -> Result<Vec<usize>, ScriptError> {
    let Ok(given) = options.array("beams") else { return Ok(Vec::new()) };
    let at = || CallPart::Key("beams".into());
    if given.is_empty() {
        return Err(call.error("no beam is given").hint("for example [rod]").at(at()));
    }
    let beam = |value: &Dynamic| {
        let handle = value.clone().try_cast::<BeamHandle>().ok_or_else(|| {
            call.error("'beams' must hold beams").hint("for example [rod]").at(at())
        })?;
        let index = handle.index_in(scene)?;
        match index < count {
            true => Ok(index),
            false => Err(call
                .error(format!("{} was added after the scene was started", handle.name()))
                .hint("add everything before scene.start(…), or start the scene again")
                .at(at())),
        }
    };
    given.iter().map(beam).collect()
}
