//! Pictures and files of equilibria, modes and buckling.

use rhai::Dynamic;

use super::files::{FILE, write_csv, write_picture};
use super::subjects::{plain, stations};
use crate::geometry::Vec2;
use crate::output::{CsvTable, LineChart, MotionFrame, MotionPicture, Page, Series, significant};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Scripted;
use crate::script::bindings::parameter::{
    Parameter, Presence, array, integer, number, object, options, text,
};
use crate::script::bindings::table::{BindingTable, function};
use crate::script::handles::equilibrium::EquilibriumHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::packages::buckling::{BUCKLING, BucklingHandle};
use crate::script::packages::equilibria::{BENT, EQUILIBRIUM};
use crate::script::packages::modes::{MODES, ModesHandle};
use crate::script::packages::scenes::STATION;
use crate::script::presentation::motion::snapshot;
use crate::script::presentation::symbols::{SceneAt, of_obstacles};
use crate::simulation::Outline;
use crate::system::Scene;
use crate::vibration::{CriticalLoad, Mode, ModeShapes};

pub const TABLE: BindingTable = BindingTable {
    name: "pictures of equilibria and modes",
    doc: "Pictures of equilibria, modes and buckling: SVG or PNG, depending on the ending of the file \
        name, and tables as CSV, in the output folder.",
    types: &[],
    setup: BENT,
    constants: &[],
    rows: &[
        function("plot_equilibrium", &[REST, FILE, options("options", SHAPES).optional()], plot_equilibrium)
            .summary("Plots configurations along the path of equilibria over each other.")
            .doc("Symbols of supports, joints, springs and loads show the last configuration. Of \
                a long path only configurations at equal intervals are plotted.")
            .example("let rest = scene.equilibrium();\nplot_equilibrium(rest, \"bent.svg\", #{ trace: [rod.end] });")
            .with_related(&["equilibrium", "plot_load_path", "plot_motion"]),
        function("plot_load_path", &[REST, object("station", STATION), FILE], plot_load_path)
            .summary("Plots the load factor over the displacements of a station, including limit \
                points.")
            .example("let rest = scene.equilibrium();\nplot_load_path(rest, rod.end, \"path.svg\");")
            .with_related(&["arc_length", "limit_points", "write_load_path"]),
        function("write_load_path", &[REST, STATIONS, FILE], write_load_path)
            .summary("Writes load factor, strain energy and the positions of stations along the path \
                as CSV with all digits.")
            .example("let rest = scene.equilibrium();\nwrite_load_path(rest, [rod.end], \"path.csv\");")
            .with_related(&["plot_load_path", "positions"]),
        function("plot_modes", &[object("modes", MODES), FILE, options("options", MODE_SHAPES).optional()], plot_modes)
            .summary("Plots mode shapes side by side, each over the equilibrium configuration.")
            .example("plot_modes(scene.modes(4), \"modes.svg\", #{ columns: 2 });")
            .with_related(&["modes"]),
        function("plot_buckling", &[object("buckling", BUCKLING), FILE, options("options", MODE_SHAPES).optional()], plot_buckling)
            .summary("Plots buckling shapes side by side, each over the undeformed scene.")
            .example("let column = new_scene(\"column\");\nlet post = column.beam(#{ axis: line([0, 0], [0, 2]), basis: bspline(4), section: s });\n\
                column.clamp(post.start);\ncolumn.force(post.end, [0, -1]);\n\
                plot_buckling(column.buckling(2), \"buckling.svg\");")
            .with_related(&["buckling", "plot_modes"]),
    ],
};

const REST: Parameter = object("equilibrium", EQUILIBRIUM);
const STATIONS: Parameter = array("stations").doc("stations, such as [rod.end]");
const SHAPES: &[Parameter] = &[
    integer("shapes").positive().or(Presence::Integer(20)).doc("largest number of configurations"),
    array("trace").doc("stations whose paths are plotted").optional(),
    text("title").doc("title; default: the name of the scene").optional(),
];
const MODE_SHAPES: &[Parameter] = &[
    number("amplitude")
        .positive()
        .or(Presence::Number(0.1))
        .doc("largest displacement, relative to the size of the scene"),
    integer("columns").positive().or(Presence::Integer(2)).doc("number of columns of pictures"),
];

fn plot_equilibrium(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.get::<EquilibriumHandle>("equilibrium")?;
    let options = call.options_or_defaults("options")?;
    let rest = handle.equilibrium();
    let scene = rest.scene();
    let title = options.optional_text("title")?.unwrap_or_else(|| scene.name.clone());
    let mut picture = MotionPicture::new(title)
        .beams(scene.beams.iter().map(|beam| beam.name.clone()))
        .time_label("load factor");
    let factors: Vec<f64> = rest.path().points().iter().map(|point| point.load_factor).collect();
    let grows = factors.is_sorted();
    if !grows {
        picture = picture.time_label("point of the path");
    }
    picture = picture.symbols(SceneAt::at_rest(&rest).symbols(rest.model())?);
    let outlines = Outline::of_scene(scene, rest.model().meshes())?;
    let configurations = rest.along_path(|model| {
        let points: Vec<&[Vec2]> = model.control_points().collect();
        Outline::draw(&outlines, 0.0, &points)
    })?;
    let apart = (factors.len() - 1).div_ceil(options.count("shapes")?).max(1);
    let last = factors.len() - 1;
    for (index, configuration) in configurations.iter().enumerate() {
        if (last - index).is_multiple_of(apart) {
            let time = if grows { factors[index] } else { index as f64 };
            picture = picture.snapshot(MotionFrame { time, ..snapshot(configuration) });
        }
    }
    for station in
        stations(call, &options.array("trace").unwrap_or_default(), CallPart::Key("trace".into()))?
    {
        let path = positions(&handle, &station)?;
        picture =
            picture.trace(format!("path of {}", station.show()), path.iter().map(plain).collect());
    }
    write_picture(call, &picture)
}

fn plot_load_path(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.get::<EquilibriumHandle>("equilibrium")?;
    let station = call.get::<StationHandle>("station")?;
    let rest = handle.equilibrium();
    let positions = positions(&handle, &station)?;
    let start = positions.first().copied().unwrap_or_default();
    let series = |name: &str, along: fn(&Vec2) -> f64| {
        let points = positions.iter().zip(rest.path().points());
        Series::new(
            name,
            points.map(|(at, point)| (along(&(at - start)), point.load_factor)).collect(),
        )
    };
    let chart = LineChart::new(rest.scene().name.clone())
        .x_label(format!("displacement of {} [length]", station.show()))
        .y_label("load factor [-]")
        .series(series("along x", |moved| moved.x))
        .series(series("along y", |moved| moved.y));
    write_picture(call, &chart)
}

fn write_load_path(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.get::<EquilibriumHandle>("equilibrium")?;
    let rest = handle.equilibrium();
    let points = rest.path().points();
    let table = CsvTable::new()
        .comment(format!("equilibria of {}", rest.scene().name))
        .column("load factor [-]", points.iter().map(|point| point.load_factor).collect())
        .column("strain [energy]", points.iter().map(|point| point.strain_energy).collect());
    let stations = stations(call, &call.array("stations")?, CallPart::Argument(1))?;
    let table = stations.iter().try_fold(table, |table, station| {
        let (name, path) = (station.show(), positions(&handle, station)?);
        Ok::<_, ScriptError>(
            table
                .column(format!("x of {name} [length]"), path.iter().map(|at| at.x).collect())
                .column(format!("y of {name} [length]"), path.iter().map(|at| at.y).collect()),
        )
    })?;
    write_csv(call, table)
}

fn plot_modes(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.get::<ModesHandle>("modes")?;
    let (scene, modes) = handle.held();
    let label = |(number, mode): (usize, &Mode)| {
        format!("mode {number}: ω = {}", significant(mode.angular_frequency(), 5))
    };
    let labels = modes.all().iter().enumerate().map(label);
    let title = format!("Modes of {}", scene.name);
    plot_shapes(call, scene, modes.shapes(), labels, title)
}

fn plot_buckling(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.get::<BucklingHandle>("buckling")?;
    let buckling = handle.buckling();
    let label = |(number, load): (usize, &CriticalLoad)| {
        format!("shape {number}: λ = {}", significant(load.factor, 5))
    };
    let labels = buckling.critical().iter().enumerate().map(label);
    let title = format!("Buckling of {}", buckling.scene().name);
    plot_shapes(call, buckling.scene(), buckling.shapes(), labels, title)
}

fn plot_shapes(
    call: &Call,
    scene: &Scene,
    shapes: &ModeShapes,
    labels: impl Iterator<Item = String>,
    title: String,
) -> Result<Dynamic, ScriptError> {
    let options = call.options_or_defaults("options")?;
    let outlines = Outline::of_scene(scene, shapes.meshes())?;
    let draw = |points: &[Vec<Vec2>]| {
        let points: Vec<&[Vec2]> = points.iter().map(Vec::as_slice).collect();
        Outline::draw(&outlines, 0.0, &points)
    };
    let at_rest = draw(shapes.points());
    let size = shapes.size() * options.number("amplitude")?;
    // All beams and bodies form one polyline, with gaps between them.
    let gap = (f64::NAN, f64::NAN);
    let lines = at_rest.lines.iter().chain(&at_rest.bodies);
    let at_rest: Vec<(f64, f64)> =
        lines.flat_map(|line| line.iter().map(plain).chain([gap])).collect();
    let pictures = labels.enumerate().map(|(number, label)| {
        MotionPicture::new(label)
            .snapshot(snapshot(&draw(&shapes.displaced(number, size))))
            .trace("at rest", at_rest.clone())
            .symbols(of_obstacles(scene).map(|(_, placed)| placed))
    });
    let page = Page::grid(options.count("columns")?).title(title);
    write_picture(call, &pictures.fold(page, Page::panel))
}

fn positions(
    handle: &EquilibriumHandle,
    station: &StationHandle,
) -> Result<Vec<Vec2>, ScriptError> {
    let place = handle.place(station)?;
    Ok(handle.equilibrium().along_path(|model| model.position(&place))?)
}
