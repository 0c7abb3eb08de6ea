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

/// Domain of pictures and files.
pub const TABLE: BindingTable = BindingTable {
    name: "pictures",
    doc: "Pictures are SVG or PNG by the ending of the file name, tables are CSV; all go into the output folder. Given an \
          array of simulations, a picture shows them side by side.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("plot_motion", &[MOVING, FILE, options("options", MOTION).optional()], plot_motion)
            .summary("Draws snapshots of the motion in one picture, axes equal, with supports, joints, sliders, springs and loads.")
            .doc(
                "Knots or nodes are dots, particles larger ones, rigid bodies the lines around their points. The last snapshot is the present unless `to` is given, and symbols are those of that time: a support is a triangle, on rollers where it leaves a direction free, or a wall \
                 where it clamps, a motor a circle with arrows, what scene.move moves a square with arrows, a joint a ring, or a square where it is rigid, a slider a diamond, a spring a zigzag, a damper a piston, a load an arrow, as long as it acts. At the prompt `:show` takes the same options.",
            )
            .example("sim.run_to(2);\nplot_motion(sim, \"spin.svg\", #{ every: 0.5, trace: [rod.end] });\nplot_motion(sim, \"large.svg\", #{ magnify: 10, every: 1, x_limits: [-1, 3] });")
            .see(&["plot", "plot_history", "plot_along", "plot_field"]),
        function("plot_history", &[RECORDED, COLUMNS, FILE, options("options", HISTORY_OPTIONS).optional()], plot_history)
            .summary("Draws columns of the history over time.")
            .doc("Of several histories, each must have the columns named. Other numbers than columns are drawn by `plot`.")
            .example(
                "sim.run_to(2);\nplot_history(sim, [\"kinetic\", \"strain\", \"energy\"], \"energy.svg\");\n\
                 plot_history(sim, [\"strain\"], \"strain.svg\", #{ average: true, title: \"Strain energy\" });\n\
                 let other = scene.start(#{ name: \"trapezoidal\", dt: 0.1, integrator: trapezoidal() });\nother.run_to(2);\n\
                 plot_history([sim, other], [\"strain\"], \"two.svg\", #{ axes: \"shared\", x_limits: [0, 1] });",
            )
            .see(&["plot", "plot_drift", "plot_along", "column", "averaged"]),
        function("plot_drift", &[RECORDED, FILE], plot_drift)
            .summary("Draws how far energy and momenta have drifted, on a logarithmic axis.")
            .example("sim.run_to(2);\nplot_drift(sim, \"drift.png\");")
            .see(&["drift"]),
        function("write_history", &[RECORDED, FILE], write_history)
            .summary("Writes all columns of the history as CSV, every digit kept.")
            .example("sim.run_to(1);\nwrite_history(sim, \"spin.csv\");")
            .see(&["write_csv", "write_npz"]),
        function("write_states", &[either("of", &[Kind::Object(SIMULATION)]), FILE], write_states)
            .summary("Writes the control points (or nodes) of all beams, and the particles, over time as CSV.")
            .example("sim.run_to(1);\nwrite_states(sim, \"points.csv\");")
            .see(&["write_npz", "write_vtk"]),
    ],
};
