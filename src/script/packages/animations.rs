//! Animated pictures of motions, as PNG files.

use rhai::Dynamic;

use super::pictures::files::FILE;
use super::pictures::options::{SYMBOLS, X_LIMITS, Y_LIMITS, limits, symbols};
use super::pictures::subjects::{MOVING, plain, simulations, stations};
use super::simulations::SPINNING;
use super::viewers::span;
use crate::elementary::whole_power;
use crate::output::{
    Animation, AxisLimits, Figure, Margins, MotionFrame, MotionPicture, OutputError, Page, Panel,
    PlacedSymbol, Point,
};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Scripted;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, array, integer, number, options, text,
};
use crate::script::bindings::table::{BindingTable, function};
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::presentation::motion::{Visibility, has_room_for_dots, placed, snapshot};

pub const TABLE: BindingTable = BindingTable {
    name: "animations",
    doc: "An animation is a PNG file with many frames, which browsers and Markdown pages such as \
        a README play; other programs show its first frame.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("write_animation", &[MOVING, FILE, options("options", ANIMATION).optional()], write_animation)
            .summary("Writes the motion as an animated PNG file that repeats without end.")
            .doc(
                "Frames are the recorded configurations nearest to evenly spaced times. An \
                array of simulations is shown side by side with equal views. Knots are dots if \
                there are at most 40 spans. All frames together have at most 256 colours. For \
                a long motion, or for details, use write_viewer, whose files are smaller.",
            )
            .example("sim.run_to(2);\nwrite_animation(sim, \"spin.png\", #{ frames: 20, fps: 10, width: 320, trace: [rod.end] });")
            .with_related(&["write_viewer", "plot_motion"]),
    ],
};

const ANIMATION: &[Parameter] = &[
    text("title").doc("title; default: the name of the first simulation").optional(),
    number("from").unit("time").doc("time of the first frame; default: the start").optional(),
    number("to").unit("time").doc("time of the last frame; default: the present").optional(),
    integer("frames").between(2.0, 1000.0).doc("number of frames").or(Presence::Integer(100)),
    integer("fps").between(1.0, 60.0).doc("frames per second").or(Presence::Integer(20)),
    integer("width")
        .between(200.0, 2000.0)
        .doc("width in pixels; default: 640, or 960 for several simulations")
        .optional(),
    array("trace").doc("stations whose paths are plotted during the motion").optional(),
    SYMBOLS,
    X_LIMITS,
    Y_LIMITS,
];

/// Width of an animation of one simulation, and of several simulations [pixels].
const WIDTHS: (f64, f64) = (640.0, 960.0);
/// Minimum height of a plot [pixels], for ticks and arrows.
const LEAST_HEIGHT: f64 = 100.0;

type TimedPath = Vec<(f64, Point)>;

struct FrameSource {
    base: MotionPicture,
    snapshots: Vec<MotionFrame>,
    symbols: Vec<Vec<PlacedSymbol>>,
    traces: Vec<(String, TimedPath)>,
}

impl FrameSource {
    fn picture(&self, frame: usize, time: f64) -> MotionPicture {
        let until = |path: &TimedPath| {
            path.iter().filter(|(at, _)| *at <= time).map(|(_, point)| *point).collect()
        };
        let picture = self.base.clone().snapshot(self.snapshots[frame].clone());
        let picture = picture.symbols(self.symbols[frame].iter().copied());
        let traces = self.traces.iter();
        traces.fold(picture, |picture, (name, path)| picture.trace(name.clone(), until(path)))
    }

    fn whole(&self) -> MotionPicture {
        let picture =
            self.snapshots.iter().cloned().fold(self.base.clone(), MotionPicture::snapshot);
        let picture = picture.symbols(self.symbols.iter().flatten().copied());
        self.traces.iter().fold(picture, |picture, (_, path)| {
            picture.trace("", path.iter().map(|(_, at)| *at).collect())
        })
    }
}

fn write_animation(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let file = call.text("file")?;
    if ![".png", ".apng"].iter().any(|ending| file.ends_with(ending)) {
        let message = format!("\"{file}\" does not end in .png");
        return Err(call
            .error(message)
            .hint("an animation is a PNG file: \"motion.png\"")
            .at(CallPart::Argument(1)));
    }
    let simulations = simulations(call)?;
    let options = call.options_or_defaults("options")?;
    let times = times(call, &simulations, &options)?;
    let traced =
        stations(call, &options.array("trace").unwrap_or_default(), CallPart::Key("trace".into()))?;
    let title = options.text("title").map(|title| title.to_string());
    let title = title.unwrap_or_else(|_| simulations[0].name().to_owned());
    let shown = symbols(&options);
    let limits = limits(&options).map_err(|wrong| wrong.in_call(call))?;
    let reels = simulations.iter().map(|of| {
        call.proceed()?;
        reel(of, &times, &traced, shown, limits)
    });
    let reels = framed(reels.collect::<Result<Vec<_>, ScriptError>>()?);
    let usual = if reels.len() == 1 { WIDTHS.0 } else { WIDTHS.1 };
    let width = options.count("width").map_or(usual, |width| width as f64);
    let decimals = decimals(&times);
    let draw = |frame: usize| -> Result<Figure, OutputError> {
        call.proceed().map_err(|_| OutputError::Paint { reason: "it was stopped".into() })?;
        let time = times[frame];
        let when = format!("{title}, t = {time:.decimals$}");
        let pictures = reels.iter().map(|reel| reel.picture(frame, time));
        match reels.as_slice() {
            [reel] => scaled(&reel.picture(frame, time).title(when), width),
            _ => scaled(&pictures.fold(Page::row(), Page::panel).title(when), width),
        }
    };
    let frames_per_second = options.count("fps")? as u16;
    let bytes = Animation { frames: times.len(), frames_per_second, draw: &draw }.to_png();
    call.proceed()?;
    call.context().write_file(&file, &bytes?)?;
    Ok(Dynamic::UNIT)
}

fn times(
    call: &Call,
    simulations: &[SimulationHandle],
    options: &Options,
) -> Result<Vec<f64>, ScriptError> {
    let spans = simulations.iter().map(|of| span(call, of, options));
    let spans = spans.collect::<Result<Vec<_>, ScriptError>>()?;
    let from = spans.iter().map(|span| span.0).fold(f64::INFINITY, f64::min);
    let to = spans.iter().map(|span| span.1).fold(f64::NEG_INFINITY, f64::max);
    let pieces = options.count("frames")? - 1;
    Ok((0..=pieces).map(|frame| from + (to - from) * frame as f64 / pieces as f64).collect())
}

fn decimals(times: &[f64]) -> usize {
    let apart = times.get(1).map_or(1.0, |second| second - times[0]);
    (0..12).find(|decimals| apart * whole_power(10.0, *decimals as i32) >= 0.999).unwrap_or(12)
}

fn reel(
    of: &SimulationHandle,
    times: &[f64],
    traced: &[StationHandle],
    shown: Visibility,
    limits: AxisLimits,
) -> Result<FrameSource, ScriptError> {
    let simulation = of.simulation();
    let has_dots = has_room_for_dots(&simulation);
    let (mut snapshots, mut symbols) = (Vec::new(), Vec::new());
    for time in times {
        let Some(configuration) = simulation.configuration_near(*time)? else { continue };
        symbols.push(shown.visible(placed(&simulation, configuration.time, None)?));
        let mut snapshot = snapshot(&configuration);
        if !has_dots {
            snapshot.marks.clear();
        }
        snapshots.push(snapshot);
    }
    let (first, last) = (times[0], times[times.len() - 1]);
    let trace = |station: &StationHandle| {
        let path = simulation.path(&station.place_in(of)?).into_iter();
        let inside = path.filter(|(time, _)| (first..=last).contains(time));
        let points = inside.map(|(time, point)| (time, plain(&point))).collect();
        Ok((format!("path of {}", station.show()), points))
    };
    let names = simulation.scene().beams.iter().map(|beam| beam.name.clone());
    Ok(FrameSource {
        base: MotionPicture::new(of.name()).beams(names).limits(limits),
        snapshots,
        symbols,
        traces: traced.iter().map(trace).collect::<Result<_, ScriptError>>()?,
    })
}

fn framed(reels: Vec<FrameSource>) -> Vec<FrameSource> {
    let all: Vec<MotionPicture> = reels.iter().map(FrameSource::whole).collect();
    let limits = MotionPicture::shared_limits(&all);
    reels.into_iter().map(|reel| FrameSource { base: reel.base.limits(limits), ..reel }).collect()
}

fn scaled(panel: &dyn Panel, width: f64) -> Result<Figure, OutputError> {
    let plot = |(width, height): (f64, f64)| {
        let Margins { left, right, top, bottom } = panel.margins(width, height);
        ((width - left - right, height - top - bottom), top + bottom)
    };
    let own = panel.size();
    let ((own_width, own_height), _) = plot(own);
    let ((inner, _), around) = plot((width, own.1 * width / own.0));
    let height = (inner.max(1.0) * own_height / own_width).max(LEAST_HEIGHT);
    panel.figure_of((width, height + around))
}
