//! Studies: conversion of options to cases, and of results to tables, files and pictures.

pub mod calls;
pub mod case_runner;
pub mod cell;
pub mod convergence;
pub mod convergence_chart;
pub mod convergence_table;
pub mod cost;
pub mod error_estimate;
pub mod error_on_meshes;
pub mod fits;
pub mod labels;
pub mod options;
pub mod parameters;
pub mod plan;
pub mod precision;
pub mod precision_chart;
pub mod precision_comparison;
pub mod precision_rows;
pub mod reference;
pub mod refined_run;
pub mod stability;
pub mod sweeps;
