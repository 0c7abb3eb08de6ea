//! Tracks: connected beams along which sliders pass from one beam to the next.

use rhai::Dynamic;

use super::scenes::{BEAM, SCENE};
use crate::beams::Station;
use crate::joints::TrackEnd;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Kind, Type};
use crate::script::bindings::parameter::{Parameter, array, boolean, options, text};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, method, property};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::track::TrackHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::system::{Scene, SystemError, TrackError};

pub const TABLE: BindingTable = BindingTable {
    name: "tracks",
    doc: "Tracks of beams that meet end to end. A slider moves along all beams of a track: \
        scene.slider(bead, track). Its position is counted along the whole track, and on a \
        closed track over all turns.",
    types: &[TRACK],
    setup: "let scene = new_scene(\"example\");\n\
            let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 1 });\n\
            let ramp = scene.beam(#{ name: \"ramp\", axis: line([0, 1], [2, 0]), basis: bspline(4), section: s });\n\
            let floor = scene.beam(#{ name: \"floor\", axis: line([5, 0], [2, 0]), basis: bspline(4), section: s });\n\
            scene.clamp(ramp.start);\n\
            scene.clamp(floor.start);\n\
            scene.rigid(ramp.end, floor.end);\n\
            let track = scene.track([ramp, floor]);",
    constants: &[],
    rows: &[
        method(
            SCENE,
            "track",
            &[
                array("beams").doc("beams in the order of the track"),
                options("options", TRACK_KEYS).optional(),
            ],
            track,
        )
        .returns(Returns::object(TRACK))
        .summary(
            "Creates a track of beams joined end to end, on which sliders pass from one \
                beam to the next.",
        )
        .doc(
            "The direction along each beam follows from the ends that meet. The beams must \
            already be joined there, by scene.rigid, scene.hinge or other joints, or be fixed \
            to the ground. A slider passes a corner like a rounded corner of vanishing radius: \
            its energy is kept, and its momentum changes by an impulse normal to the track. \
            Where a joint of the track is released and the beams have separated, the track \
            ends. A slider that starts at a corner is on the beam after it. A closed track of \
            two beams has the direction of the first beam. Default names: track1, track2, …",
        )
        .example(
            "scene.gravity([0, -10]);\n\
                 let bead = scene.particle([0, 1], 1, #{ name: \"bead\" });\n\
                 let ring = scene.slider(bead, track, #{ name: \"ring\", at: 0 });\n\
                 let sim = scene.start(#{ dt: 0.02 });\n\
                 sim.run_to(1.2);\n\
                 check(sim.slider_arc_length(ring) > ramp.length);\n\
                 check(sim.events[0].what == \"passed\" && sim.history.drift(\"energy\") < 1e-10);",
        )
        .with_related(&["slider", "rigid", "events"]),
        property(TRACK, "name", |call| Ok(call.receiver::<TrackHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Name of the track.")
            .example("check(track.name == \"track1\");"),
        property(TRACK, "length", |call| Ok(call.receiver::<TrackHandle>()?.length().into()))
            .returns(Returns::NUMBER.unit("length"))
            .summary("Total undeformed length of the beams of the track.")
            .example("check_close(track.length, ramp.length + floor.length, 1e-12);")
            .with_related(&["slider_arc_length"]),
        property(TRACK, "closed", |call| Ok(call.receiver::<TrackHandle>()?.is_closed().into()))
            .returns(Returns::BOOLEAN)
            .summary("True if the last beam leads back to the first one.")
            .example("check(!track.closed);"),
    ],
};

pub(super) const TRACK: Type = Type::of::<TrackHandle>();

const TRACK_KEYS: &[Parameter] = &[
    boolean("closed")
        .doc(
            "true if the last beam leads back to the start of the first one, so that sliders \
            circulate; default: false",
        )
        .optional(),
    text("name").optional(),
];

#[derive(Clone, Copy)]
pub(super) enum SliderGuide {
    Beam(usize),
    Track(usize),
}

impl SliderGuide {
    pub(super) fn of(call: &Call, name: &str, scene: &SceneHandle) -> Result<Self, ScriptError> {
        match call.get_if::<TrackHandle>(name) {
            Some(track) => track.index_in(scene).map(Self::Track),
            None => call.get::<BeamHandle>(name)?.index_in(scene).map(Self::Beam),
        }
    }

    pub(super) fn track(self) -> Option<usize> {
        match self {
            Self::Beam(_) => None,
            Self::Track(track) => Some(track),
        }
    }

    pub(super) fn start(
        self,
        scene: &Scene,
        slave: Station,
        at: Option<f64>,
    ) -> Result<(usize, f64), SystemError> {
        match (self, at) {
            (Self::Beam(beam), Some(part)) => Ok((beam, part * scene.beams[beam].axis.length())),
            (Self::Beam(beam), None) => Ok((beam, scene.nearest_arc_length(beam, &slave)?)),
            (Self::Track(track), Some(part)) => {
                Ok(scene.place_on_track(track, part * scene.track_length(track)))
            }
            (Self::Track(track), None) => scene.nearest_on_track(track, &slave),
        }
    }
}

fn track(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let mut beams = Vec::new();
    for (index, given) in call.array("beams")?.into_iter().enumerate() {
        let wanted = (&Kind::Object(BEAM), "a beam");
        let beam = call.accept("track", &format!("beam {}", index + 1), wanted, given)?;
        beams.push(beam.cast::<BeamHandle>().index_in(&scene)?);
    }
    let options = call.options_or_defaults("options")?;
    let is_closed = options.get_if("closed").unwrap_or(false);
    let course = if is_closed { TrackEnd::Closed } else { TrackEnd::Open };
    let name = options.optional_text("name")?;
    let name = name.unwrap_or_else(|| scene.scene().borrow().free_name("track"));
    let added = scene.change().add_track(name, &beams, course);
    let index = added.map_err(|error| {
        let place = match &error {
            SystemError::Track(error) if matches!(**error, TrackError::Open { .. }) => {
                CallPart::Key("closed".into())
            }
            SystemError::Track(_) => CallPart::Argument(0),
            _ => CallPart::Key("name".into()),
        };
        ScriptError::from(error).at(place)
    })?;
    Ok(Dynamic::from(TrackHandle { scene, index }))
}
