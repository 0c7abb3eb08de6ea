//! Cross sections and meshes of beams.

use std::rc::Rc;

use rhai::{Dynamic, INT};

use super::geometry::KNOTS;

use crate::beams::{
    BeamError, Mesh, Quadrature, Relaxation, Section, SectionShape, SectionVariation, Solid,
};
use crate::geometry::{Basis, KnotVector};
use crate::script::bindings::arguments::Arguments;
use crate::script::bindings::call::Call;
use crate::script::bindings::key_sets::{KeySet, KeySets};
use crate::script::bindings::kind::{Details, Kind, NumberRange, Scripted, Type};
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, choice, either, integer, number, options,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, property};
use crate::script::handles::section::SectionHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::presentation::details;

pub const TABLE: BindingTable = BindingTable {
    name: "sections",
    doc: "Cross sections and meshes of beams, in any consistent set of units.",
    types: &[SECTION, MESH],
    setup: "",
    constants: &[],
    rows: &[
        function("section", &[SECTION_OPTIONS], section)
            .returns(Returns::object(SECTION))
            .summary("Creates a cross section from stiffness and inertia, or from a material and a \
                shape.")
            .doc(
                "Give either EA, GA, EI, rho_A and rho_I; or E, nu, density and a shape: \
                \"rectangle\" with width and height (height lies in the plane of motion), \
                \"circle\" with radius, \"tube\" with outer and inner radius. GA includes the \
                shear correction factor; shapes use that of Cowper (1966). damping sets the \
                relaxation times of a Kelvin–Voigt material: the bending moment is EI (κ + \
                bending · κ̇), and likewise for axial and shear strain. The dissipated energy \
                is recorded in the columns dissipated and dissipated.NAME of the beam. At \
                frequency ω the damping ratio in bending is bending · ω/2.",
            )
            .example(
                "let rubber = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10, damping: #{ bending: 1e-3, axial: 1e-4 } });\n\
                 let slender = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
                 let steel = section(#{ E: 210e9, nu: 0.3, density: 7850, shape: \"rectangle\", width: 0.02, height: 0.01 });\n\
                 check_close(steel.EA, 210e9 * 0.02 * 0.01, 1);",
            )
            .with_related(&["taper", "beam"]),
        property(SECTION, "EA", |call| of_uniform(call, |section| section.axial_stiffness))
            .returns(Returns::NUMBER)
            .summary("Axial stiffness [force].")
            .example("let slender = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\ncheck(slender.EA == 1e4);"),
        property(SECTION, "GA", |call| of_uniform(call, |section| section.shear_stiffness))
            .returns(Returns::NUMBER)
            .summary("Shear stiffness, including the shear correction factor [force].")
            .example("let slender = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\ncheck(slender.GA == 1e4);"),
        property(SECTION, "EI", |call| of_uniform(call, |section| section.bending_stiffness))
            .returns(Returns::NUMBER)
            .summary("Bending stiffness [force·length²].")
            .example("let slender = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\ncheck(slender.EI == 100);"),
        property(SECTION, "rho_A", |call| of_uniform(call, |section| section.mass_per_length))
            .returns(Returns::NUMBER)
            .summary("Mass per length [mass/length].")
            .example("let slender = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\ncheck(slender.rho_A == 1);"),
        property(SECTION, "rho_I", |call| of_uniform(call, |section| section.rotary_inertia))
            .returns(Returns::NUMBER)
            .summary("Rotary inertia per length [mass·length].")
            .example("let slender = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\ncheck(slender.rho_I == 10);"),
        function("bspline", &[either("spans", &[COUNT, Kind::Options(BSPLINE)])], bspline)
            .returns(Returns::object(MESH))
            .summary("Creates a mesh of B-splines; default: cubic and C2.")
            .doc(
                "bspline(14) has 14 equal spans. quadrature selects the points at which axial \
                and shear strain are sampled. \"patch\" (default) has neither locking nor \
                zero-energy modes for any degree and continuity. A whole number gives that \
                many Gauss points per span, for studies; such a mesh states when printed if it \
                has too many points (locking of stiff beams) or too few (zero-energy modes).",
            )
            .example(
                "let mesh = bspline(14);\ncheck(mesh.spans == 14);\n\
                 let paper = bspline(#{ spans: 7, continuity: 1, quadrature: 3 });\nprint(paper); // … 3 points for the strain: locks",
            )
            .with_related(&["lagrange", "knots", "beam"]),
        function("lagrange", &[either("elements", &[COUNT, Kind::Options(LAGRANGE)])], lagrange)
            .returns(Returns::object(MESH))
            .summary("Creates a mesh of Lagrange elements of degree 1 (default), 2 or 3.")
            .example("let mesh = lagrange(#{ elements: 5, degree: 3 });\ncheck(mesh.degree == 3);")
            .with_related(&["bspline"]),
        property(MESH, "spans", |call| whole_number(call.receiver::<Mesh>()?.spans()))
            .returns(Returns::INTEGER)
            .summary("Number of spans or elements.")
            .example("check(bspline(7).spans == 7);"),
        property(MESH, "degree", |call| whole_number(call.receiver::<Mesh>()?.basis().degree()))
            .returns(Returns::INTEGER)
            .summary("Polynomial degree of the basis functions.")
            .example("check(bspline(7).degree == 3);"),
        property(MESH, "functions", |call| whole_number(call.receiver::<Mesh>()?.basis().functions()))
            .returns(Returns::INTEGER)
            .summary("Number of basis functions, equal to the number of control points or nodes.")
            .example("check(bspline(#{ spans: 7, continuity: 1 }).functions == 16);"),
    ],
};

pub const SECTION: Type = Type::of::<SectionHandle>();
pub const MESH: Type = Type::of::<Mesh>();

const COUNT: Kind = Kind::Integer(NumberRange::Positive);
const SECTION_OPTIONS: Parameter = options("options", SECTION_KEYS);
const SECTION_KEYS: &[Parameter] = &[
    number("EA").unit("force").doc("axial stiffness").optional(),
    number("GA")
        .unit("force")
        .doc("shear stiffness, including the shear correction factor")
        .optional(),
    number("EI").unit("force·length²").doc("bending stiffness").optional(),
    number("rho_A").unit("mass/length").doc("mass per length").optional(),
    number("rho_I").unit("mass·length").doc("rotary inertia per length").optional(),
    number("E").unit("force/length²").doc("Young's modulus").optional(),
    number("nu").doc("Poisson's ratio").optional(),
    number("density").unit("mass/length³").doc("density").optional(),
    choice("shape", &["rectangle", "circle", "tube"]).doc("shape of the cross section").optional(),
    number("width").unit("length").doc("width of a rectangle, out of the plane").optional(),
    number("height").unit("length").doc("height of a rectangle, in the plane").optional(),
    number("radius").unit("length").doc("radius of a circle").optional(),
    number("outer").unit("length").doc("outer radius of a tube").optional(),
    number("inner").unit("length").doc("inner radius of a tube").optional(),
    options("damping", DAMPING_KEYS)
        .doc("relaxation times of the material; default: no damping")
        .optional(),
];
const DAMPING_KEYS: &[Parameter] = &[
    number("axial").non_negative().unit("time").or(Presence::Number(0.0)),
    number("shear").non_negative().unit("time").or(Presence::Number(0.0)),
    number("bending").non_negative().unit("time").or(Presence::Number(0.0)),
];

#[derive(Clone, Copy)]
enum GivenBy {
    Stiffness,
    Rectangle,
    Circle,
    Tube,
}

const GIVEN_BY: KeySets<GivenBy> = KeySets {
    description: "a section is given by EA, GA, EI, rho_A, rho_I, or by E, nu, density and a shape",
    always_allowed: &["damping"],
    sets: &[
        KeySet {
            meaning: GivenBy::Stiffness,
            description: "its stiffness and inertia",
            keys: &["EA", "GA", "EI", "rho_A", "rho_I"],
            chosen_by: None,
        },
        KeySet {
            meaning: GivenBy::Rectangle,
            description: "a material and the shape \"rectangle\"",
            keys: &["shape", "width", "height", "E", "nu", "density"],
            chosen_by: Some(("shape", "rectangle")),
        },
        KeySet {
            meaning: GivenBy::Circle,
            description: "a material and the shape \"circle\"",
            keys: &["shape", "radius", "E", "nu", "density"],
            chosen_by: Some(("shape", "circle")),
        },
        KeySet {
            meaning: GivenBy::Tube,
            description: "a material and the shape \"tube\"",
            keys: &["shape", "outer", "inner", "E", "nu", "density"],
            chosen_by: Some(("shape", "tube")),
        },
    ],
};
const QUADRATURE: Parameter = either("quadrature", &[Kind::Choice(&["patch"]), COUNT])
    .doc("points for axial and shear strain")
    .or(Presence::Text("patch"));
const BSPLINE: &[Parameter] = &[
    integer("spans").positive().doc("number of equal spans"),
    integer("degree").positive().or(Presence::Integer(3)),
    integer("continuity")
        .non_negative()
        .doc("number of continuous derivatives between spans; default: degree - 1")
        .optional(),
    QUADRATURE,
];
const LAGRANGE: &[Parameter] = &[
    integer("elements").positive().doc("number of equal elements"),
    integer("degree").between(1.0, 3.0).or(Presence::Integer(1)),
    QUADRATURE,
];

impl Scripted for Mesh {
    const NAME: &'static str = "mesh";
    const DOC: &'static str = "A basis for a beam with the quadrature points of its strains.";

    fn show(&self) -> String {
        self.describe()
    }

    fn details(&self) -> Details {
        details::of_mesh(self)
    }
}

fn whole_number(count: usize) -> Result<Dynamic, ScriptError> {
    Ok(Dynamic::from(count as INT))
}

fn section(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options("options")?;
    let (section, solid) = section_of(&options)?;
    let relaxation = relaxation(&options)?;
    Ok(Dynamic::from(SectionHandle { variation: section.into(), solid, relaxation }))
}

fn of_uniform(call: &Call, number: fn(&Section) -> f64) -> Result<Dynamic, ScriptError> {
    match &call.receiver::<SectionHandle>()?.variation {
        SectionVariation::Uniform(section) => Ok(number(section).into()),
        tapered => {
            let [start, end] = [0.0, 1.0].map(|part| number(&tapered.at(part)));
            let message =
                format!("this value varies along a taper: {start} at its start, {end} at its end");
            Err(call.error(message).hint("read the section at one place: taper.at(0.5).EI"))
        }
    }
}

fn relaxation(options: &Options) -> Result<Option<Relaxation>, ScriptError> {
    let times = options.options_or_defaults("damping")?;
    let relaxation = Relaxation {
        axial: times.number("axial")?,
        shear: times.number("shear")?,
        bending: times.number("bending")?,
    };
    Ok((relaxation != Relaxation::default()).then_some(relaxation))
}

fn section_of(options: &Options) -> Result<(Section, Option<Solid>), ScriptError> {
    let number = |name: &str| options.number(name);
    let shape = match GIVEN_BY.choose("section", options)? {
        GivenBy::Stiffness => return Ok((from_stiffness(options)?, None)),
        GivenBy::Rectangle => {
            SectionShape::Rectangle { width: number("width")?, height: number("height")? }
        }
        GivenBy::Circle => SectionShape::Circle { radius: number("radius")? },
        GivenBy::Tube => SectionShape::Tube { outer: number("outer")?, inner: number("inner")? },
    };
    let (young, poisson, density) = (number("E")?, number("nu")?, number("density")?);
    let solid = Solid { youngs_modulus: young, poisson, density, shape };
    Ok((Section::from_solid(solid).map_err(section_error)?, Some(solid)))
}

fn from_stiffness(options: &Options) -> Result<Section, ScriptError> {
    let section = Section {
        axial_stiffness: options.number("EA")?,
        shear_stiffness: options.number("GA")?,
        bending_stiffness: options.number("EI")?,
        mass_per_length: options.number("rho_A")?,
        rotary_inertia: options.number("rho_I")?,
    };
    section.validated().map_err(section_error)
}

fn section_error(error: BeamError) -> ScriptError {
    let key = match &error {
        BeamError::SectionValue { name, .. } => Some(*name),
        BeamError::PoissonRatio { .. } => Some("nu"),
        BeamError::Tube { .. } => Some("inner"),
        _ => None,
    };
    let error = ScriptError::from(error);
    match key {
        Some(key) => error.at(CallPart::Key(key.to_owned())),
        None => error,
    }
}

fn bspline(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let Some(options) = call.get_if::<Options>("spans") else {
        return Ok(Dynamic::from(Mesh::bspline(call.count("spans")?, 3, 2)?));
    };
    let degree = options.count("degree")?;
    let continuity = if options.has("continuity") {
        options.count("continuity")?
    } else {
        degree.saturating_sub(1)
    };
    with_quadrature(Mesh::bspline(options.count("spans")?, degree, continuity)?, &options)
}

fn lagrange(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let Some(options) = call.get_if::<Options>("elements") else {
        return Ok(Dynamic::from(Mesh::lagrange(call.count("elements")?, 1)?));
    };
    with_quadrature(Mesh::lagrange(options.count("elements")?, options.count("degree")?)?, &options)
}

fn with_quadrature(mesh: Mesh, options: &Options) -> Result<Dynamic, ScriptError> {
    let quadrature = match options.count("quadrature") {
        Ok(points) => Quadrature::Points(points),
        Err(_) => Quadrature::Patch,
    };
    let mesh = mesh.with_quadrature(quadrature);
    Ok(Dynamic::from(
        mesh.map_err(|error| ScriptError::from(error).at(CallPart::Key("quadrature".into())))?,
    ))
}

pub(super) fn mesh_of(arguments: &Arguments, name: &str) -> Option<Mesh> {
    let knots = |knots: Rc<KnotVector>| Mesh::new(Basis::BSpline(KnotVector::clone(&knots)));
    arguments.get_if::<Mesh>(name).or_else(|| arguments.get_if::<Rc<KnotVector>>(name).map(knots))
}

pub(super) const MESH_KINDS: &[Kind] = &[Kind::Object(MESH), Kind::Object(KNOTS)];
