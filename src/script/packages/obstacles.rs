//! Contact: walls and discs that bodies can touch, and bodies that can touch each other.

use rhai::Dynamic;

use super::scenes::{BEAM, SCENE, STATION};
use crate::geometry::Vec2;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Kind, NumberRange};
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, array, either, number, options, point, text,
};
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::as_number;
use crate::system::{
    ContactMember, ContactTarget, Obstacle, ObstacleShape, PairContact, SystemError,
};

pub const TABLE: BindingTable = BindingTable {
    name: "obstacles",
    doc: "Walls and discs that are fixed to the ground, the contact of beams, particles and \
        points of rigid bodies with them, and contact between bodies. The contact is compliant: its force follows from a \
        potential of the penetration. E - W + D and both momenta stay constant to rounding with \
        energy_momentum() and fourth_order(), at any step size and stiffness. The history has \
        the columns NAME.force, NAME.force_x, NAME.force_y (the force on the bodies, mean of the \
        step), NAME.gap (the smallest gap, negative for a penetration), stored.NAME and \
        dissipated.NAME. With friction there is also NAME.friction, the friction force on the bodies, \
        positive to the right of the normal (on a disc: clockwise). \
        Pictures and the viewer show walls with hatching behind them, and discs.",
    types: &[],
    setup: super::scenes::ROD,
    constants: &[],
    rows: &[
        method(SCENE, "wall", &[point("point").unit("length"), point("normal"), options("options", KEYS)], wall)
            .summary("Adds a wall: a straight boundary that bodies can touch from the side to which \
                its normal points, such as a floor.")
            .doc("The normal can have any length. The wall is infinite; several walls form a \
                channel or a box. A beam touches it all along, at four Gauss–Lobatto points per \
                span, its ends included. On a beam, stiffness is the force per length and \
                penetration, on a point the force per penetration. With friction, contact \
                sticks or slips (Coulomb); the friction force acts at the surface, at the distance \
                radius from the axis, so a round body rolls. The contact deflects elastically along \
                the surface before it slips and springs back, so an oblique impact without slip \
                rebounds along the surface too, unlike with rigid Coulomb friction. Choose the \
                stiffness so that the largest \
                expected force gives a small penetration. With a restitution below 1 the contact \
                is damped so that a resolved impact of a single mass rebounds with this fraction \
                of its speed. sim.notes states impacts that the steps do not resolve, and \
                bodies that start inside an obstacle. Default names: wall1, wall2, …")
            .example("let ball = scene.particle([1, 2], 0.5, #{ name: \"ball\" });\n\
                      scene.gravity([0, -9.81]);\n\
                      scene.wall([0, -3], [0, 1], #{ stiffness: 1e4, restitution: 0.8, name: \"floor\" });\n\
                      let sim = scene.start(#{ dt: 0.005 });\nsim.run_to(1.5);\n\
                      check(min(sim.history.column(\"floor.gap\")) < 0);\n\
                      check(sim.history.drift(\"energy\") < 1e-12);")
            .with_related(&["disc", "slider", "spring"]),
        method(SCENE, "disc", &[point("centre").unit("length"), number("radius").positive().unit("length"), options("options", KEYS)], disc)
            .summary("Adds a disc that bodies can touch from outside, such as a pin or a peg.")
            .doc("The contact force points from the centre to the body. Its potential is infinite \
                at the centre, so a body that touches the disc cannot pass its centre. A step in \
                which a point would pass through the disc is halved. A disc that is smaller than \
                the distance of the contact points of a beam can pass between them: use more \
                spans. Options and columns are those \
                of wall. Default names: disc1, disc2, …")
            .example("let ball = scene.particle([1.1, 2], 0.5, #{ name: \"ball\" });\n\
                      scene.gravity([0, -9.81]);\n\
                      scene.disc([1, 1], 0.3, #{ stiffness: 1e4, bodies: [ball], name: \"peg\" });\n\
                      let sim = scene.start(#{ dt: 0.002 });\nsim.run_to(1);\n\
                      check(max(sim.history.column(\"peg.force\")) > 10);\n\
                      check(sim.history.drift(\"energy\") < 1e-12);")
            .with_related(&["wall", "contact"]),
        method(SCENE, "contact", &[array("bodies"), options("options", CONTACT_KEYS)], contact)
            .summary("Lets bodies touch each other: beams, particles, and stations of rigid bodies. A single \
                beam touches itself.")
            .doc("Each body has a radius: half the thickness of a beam, or the radius of a disc around \
                a particle or a station. A beam has the shape of its axis with this radius. Its contact \
                points (four per span) touch the nearest points of the other axes. The contact is \
                compliant: its potential is infinite where two axes meet, so beams that touch do not pass \
                through each other, and a step in which a point would jump through an axis is halved. \
                A body that fits between two contact points is not seen by them: use spans that are \
                shorter than the bodies. \
                With friction, contact sticks or slips (Coulomb), and round bodies roll on each other. \
                A particle does not rotate, so friction between two particles is refused. \
                Between two beams, stiffness is the force per length and penetration, otherwise the \
                force per penetration. Bodies that share a joint or a slider do not touch each other. \
                NAME.force_x and NAME.force_y are the force on the first body of the list; it is zero \
                if a beam touches itself. NAME.friction is positive to the right of the normal that points to the first body. NAME.gap of bodies that do not touch is accurate to 0.1 %. Default \
                names: contact1, contact2, …")
            .example("scene.clamp(rod.start);\nscene.clamp(rod.end);\n\
                      let ball = scene.particle([0.7, 1], 0.5, #{ name: \"ball\" });\n\
                      scene.gravity([0, -9.81]);\n\
                      scene.contact([rod, ball], #{ stiffness: 1e4, radius: 0.05, name: \"hit\" });\n\
                      let sim = scene.start(#{ dt: 0.002 });\nsim.run_to(0.6);\n\
                      check(max(sim.history.column(\"hit.force\")) > 1);\n\
                      check(sim.history.drift(\"energy\") < 1e-12);")
            .with_related(&["wall", "disc", "slider"]),
    ],
};

const FRICTION: Parameter = number("friction")
    .non_negative()
    .doc("coefficient of friction along the surface; not with fourth_order()")
    .or(Presence::Number(0.0));

const KEYS: &[Parameter] = &[
    number("stiffness")
        .positive()
        .unit("force/length, force/length² on beams")
        .doc("force per penetration; on a beam per length"),
    number("restitution")
        .between(0.05, 1.0)
        .doc("fraction of the approach speed after a resolved impact; 1 is elastic")
        .or(Presence::Number(1.0)),
    FRICTION,
    number("radius")
        .non_negative()
        .unit("length")
        .doc("radius of the bodies around their axes and points, such as half the thickness of a beam")
        .or(Presence::Number(0.0)),
    array("bodies")
        .doc(
            "beams, particles, and stations of beams and rigid bodies that can touch it; default: \
            all beams and particles of the scene",
        )
        .optional(),
    text("name").optional(),
];

const CONTACT_KEYS: &[Parameter] = &[
    number("stiffness")
        .positive()
        .unit("force/length, force/length² between beams")
        .doc("force per penetration; between two beams per length"),
    either("radius", &[Kind::Number(NumberRange::Positive), Kind::Numbers])
        .unit("length")
        .doc("radius of the bodies around their axes and points; a number for all bodies, or an array with one number per body"),
    number("restitution")
        .between(0.05, 1.0)
        .doc("fraction of the approach speed after a resolved impact; 1 is elastic")
        .or(Presence::Number(1.0)),
    FRICTION,
    text("name").optional(),
];

fn contact(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options("options")?;
    let bodies = call.get::<rhai::Array>("bodies")?;
    let count = bodies.len();
    let targets = read_targets(call, "contact", &scene, (bodies, CallPart::Argument(0)))?;
    let radii = match as_number(&options.value("radius")?) {
        Some(radius) => vec![radius; count],
        None => options.numbers("radius")?,
    };
    if radii.len() != count {
        let message = format!("radius has {} numbers, but {count} bodies are listed", radii.len());
        let hint = "give one radius per body, or one number for all bodies";
        return Err(call.error(message).hint(hint).at(CallPart::Key("radius".into())));
    }
    let member = |(target, radius)| ContactMember { target, radius };
    let name = options.optional_text("name")?;
    let contact = PairContact {
        name: name.unwrap_or_else(|| scene.scene().borrow().free_name("contact")),
        members: targets.into_iter().zip(radii).map(member).collect(),
        stiffness: options.number("stiffness")?,
        restitution: options.number("restitution")?,
        friction: options.number("friction")?,
    };
    scene.change().add_contact(contact).map_err(place_of_error)?;
    Ok(Dynamic::UNIT)
}

fn wall(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (point, normal) = (call.get::<Vec2>("point")?, call.get::<Vec2>("normal")?);
    let length = normal.norm();
    if length == 0.0 {
        let message = "the normal of a wall has length 0";
        let hint = "give a direction, such as [0, 1] for a floor";
        return Err(call.error(message).hint(hint).at(CallPart::Argument(1)));
    }
    add(call, ObstacleShape::HalfPlane { point, normal: normal / length }, "wall")
}

fn disc(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (centre, radius) = (call.get::<Vec2>("centre")?, call.number("radius")?);
    add(call, ObstacleShape::Disc { centre, radius }, "disc")
}

fn add(call: &mut Call, shape: ObstacleShape, function: &str) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options("options")?;
    let name = options.optional_text("name")?;
    let name = name.unwrap_or_else(|| scene.scene().borrow().free_name(function));
    let obstacle = Obstacle {
        name,
        shape,
        targets: targets(call, function, &scene, &options)?,
        radius: options.number("radius")?,
        stiffness: options.number("stiffness")?,
        restitution: options.number("restitution")?,
        friction: options.number("friction")?,
    };
    scene.change().add_obstacle(obstacle).map_err(place_of_error)?;
    Ok(Dynamic::UNIT)
}

fn place_of_error(error: SystemError) -> ScriptError {
    let place = match &error {
        SystemError::Unnamed { .. } | SystemError::DuplicateName { .. } => {
            CallPart::Key("name".into())
        }
        _ => CallPart::Argument(0),
    };
    ScriptError::from(error).at(place)
}

const TARGET: &[Kind] = &[Kind::Object(BEAM), Kind::Object(STATION)];

fn targets(
    call: &Call,
    function: &str,
    scene: &SceneHandle,
    options: &Options,
) -> Result<Vec<ContactTarget>, ScriptError> {
    let Some(bodies) = options.get_if::<rhai::Array>("bodies") else { return Ok(Vec::new()) };
    if bodies.is_empty() {
        let message = "bodies is empty, so nothing can touch the obstacle";
        let hint = "leave bodies out for all beams and particles of the scene";
        return Err(call.error(message).hint(hint).at(CallPart::Key("bodies".into())));
    }
    read_targets(call, function, scene, (bodies, CallPart::Key("bodies".into())))
}

fn read_targets(
    call: &Call,
    function: &str,
    scene: &SceneHandle,
    (bodies, part): (rhai::Array, CallPart),
) -> Result<Vec<ContactTarget>, ScriptError> {
    let target = |(at, body): (usize, Dynamic)| {
        let wanted = (&Kind::Either(TARGET), "a beam, a particle, or a station");
        let accepted = call.accept(function, &format!("body {}", at + 1), wanted, body);
        let accepted = accepted.map_err(|error| error.at(part.clone()))?;
        match accepted.read_lock::<BeamHandle>() {
            Some(beam) => Ok(ContactTarget::Beam(beam.index_in(scene)?)),
            None => {
                let station = accepted.clone().cast::<StationHandle>();
                Ok(ContactTarget::Point(scene.own_station(&station)?))
            }
        }
    };
    bodies.into_iter().enumerate().map(target).collect()
}
