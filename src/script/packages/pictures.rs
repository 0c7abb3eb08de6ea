//! Pictures and files of simulations.

pub mod along;
pub mod curves;
pub mod files;
mod histories;
pub mod motion;
pub mod options;
pub mod rest;
pub mod subjects;
mod tables;

use files::FILE;
use histories::{COLUMNS, HISTORY_OPTIONS, plot_drift, plot_history};
use motion::{MOTION, plot_motion};
use subjects::{MOVING, RECORDED};
use tables::{write_history, write_states};

use super::simulations::{SIMULATION, SPINNING};
use crate::script::bindings::kind::Kind;
use crate::script::bindings::parameter::{either, options};
use crate::script::bindings::table::{BindingTable, function};

pub const TABLE: BindingTable = BindingTable {
    name: "pictures",
    doc: "Pictures of simulations. Pictures are SVG or PNG, depending on the ending of the file \
        name, and tables are CSV; all are written to the output folder. An array of \
        simulations is shown side by side.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("plot_motion", &[MOVING, FILE, options("options", MOTION).optional()], plot_motion)
            .summary("Plots snapshots of the motion in one picture with equal axes, including \
                supports, joints, sliders, springs and loads.")
            .doc(
                "Knots or nodes are dots, particles are larger dots, rigid bodies are the lines \
                around their points. The last snapshot is at `to`, default: the present; \
                symbols show the state at that time. A support is a triangle, on rollers if a \
                direction is free; a clamp is a wall; a motor is a circle with arrows; a drive \
                of scene.move is a square with arrows; a joint is a ring, or a square if it is \
                rigid; a slider is a diamond; a spring is a zigzag; a damper is a piston; a \
                load is an arrow while it acts. The command `:show` at the prompt takes the \
                same options.",
            )
            .example("sim.run_to(2);\nplot_motion(sim, \"spin.svg\", #{ every: 0.5, trace: [rod.end] });\nplot_motion(sim, \"large.svg\", #{ magnify: 10, every: 1, x_limits: [-1, 3] });")
            .with_related(&["plot", "plot_history", "plot_along", "plot_field"]),
        function("plot_history", &[RECORDED, COLUMNS, FILE, options("options", HISTORY_OPTIONS).optional()], plot_history)
            .summary("Plots columns of the history over time.")
            .doc("Columns of different units are drawn in panels below each other, one for each \
                unit. Each of several histories must have the named columns. With `error: true`, thin \
                lines show the values plus and minus their estimated errors. Use `plot` for other \
                numbers.")
            .example(
                "sim.run_to(2);\nplot_history(sim, [\"kinetic\", \"strain\", \"energy\"], \"energy.svg\");\n\
                 plot_history(sim, [\"strain\"], \"strain.svg\", #{ average: true, title: \"Strain energy\" });\n\
                 let other = scene.start(#{ name: \"trapezoidal\", dt: 0.1, integrator: trapezoidal() });\nother.run_to(2);\n\
                 plot_history([sim, other], [\"strain\"], \"two.svg\", #{ axes: \"shared\", x_limits: [0, 1] });\n\
                 plot_history(sim, [\"strain\"], \"band.svg\", #{ error: true });",
            )
            .with_related(&["plot", "plot_drift", "plot_along", "column", "averaged"]),
        function("plot_drift", &[RECORDED, FILE], plot_drift)
            .summary("Plots the drift of energy and momenta on a logarithmic axis.")
            .example("sim.run_to(2);\nplot_drift(sim, \"drift.png\");")
            .with_related(&["drift"]),
        function("write_history", &[RECORDED, FILE], write_history)
            .summary("Writes all columns of the history as CSV with all digits.")
            .example("sim.run_to(1);\nwrite_history(sim, \"spin.csv\");")
            .with_related(&["write_csv", "write_npz"]),
        function("write_states", &[either("of", &[Kind::Object(SIMULATION)]), FILE], write_states)
            .summary("Writes the control points (or nodes) of all beams, and the particles, over \
                time as CSV.")
            .example("sim.run_to(1);\nwrite_states(sim, \"points.csv\");")
            .with_related(&["write_npz", "write_vtk"]),
    ],
};
