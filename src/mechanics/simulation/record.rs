//! Recorded results of a run: history and trajectory.

use std::collections::HashSet;

use super::columns::{ExtraColumn, FIXED};
use super::progress::StepTaken;
use super::{DriftScales, History, Recording, Sample, Trajectory};
use crate::geometry::Vec2;
use crate::system::{Scene, Sensor, SensorReader, System, SystemError};

#[derive(Debug, Clone)]
pub(super) struct RunRecord {
    pub(super) history: History,
    pub(super) trajectory: Trajectory,
    pub(super) recording: Recording,
    pub(super) permanent_rows: usize,
    pub(super) sensors: Vec<Sensor>,
    reader: SensorReader,
}

impl RunRecord {
    pub(super) fn new(scene: &Scene, model: &mut System) -> Result<Self, SystemError> {
        let sensors = scene.history_sensors();
        let columns = sensors.iter().map(|sensor| ExtraColumn {
            name: sensor.name.clone(),
            dimension: sensor.quantity.dimension,
        });
        let columns: Vec<ExtraColumn> = columns.collect();
        check_names(&columns)?;
        let points = model.control_points().map(<[Vec2]>::len).sum::<usize>();
        let mut record = Self {
            history: History::new(scales(scene, model), columns),
            trajectory: Trajectory::new(2 * points),
            recording: Recording::default(),
            permanent_rows: 0,
            reader: SensorReader::of(&sensors, scene, model)?,
            sensors,
        };
        model.enable_means_for(&record.sensors);
        model.start_means();
        record.store_row(model, StepTaken::default());
        Ok(record)
    }

    pub(super) fn relocate_sensors(
        &mut self,
        scene: &Scene,
        model: &System,
    ) -> Result<(), SystemError> {
        self.reader = SensorReader::of(&self.sensors, scene, model)?;
        Ok(())
    }

    pub(super) fn reserve(&mut self, steps: usize) {
        let rows = self.recording.rows_of(steps);
        self.history.reserve(rows);
        self.trajectory.reserve(rows);
    }

    pub(super) fn store_row(&mut self, model: &mut System, last_step: StepTaken) {
        self.add_row(model, last_step);
        self.permanent_rows = self.history.samples().len();
    }

    pub(super) fn append_present(&mut self, model: &mut System, last_step: StepTaken) {
        let last = self.history.samples().last().map(|row| row.measures.time);
        if last != Some(model.time()) {
            self.add_row(model, last_step);
        }
    }

    fn add_row(&mut self, model: &mut System, last_step: StepTaken) {
        self.truncate(self.permanent_rows);
        let StepTaken { dt, newton_iterations, retries, returned } = last_step;
        let measures = model.measure();
        let sample = Sample { measures, dt, newton_iterations, retries, returned };
        self.history.push(sample, self.reader.read(model).iter().copied());
        self.trajectory.push(model.time(), coordinates(model));
    }

    pub(super) fn truncate(&mut self, rows: usize) {
        self.permanent_rows = rows;
        self.history.truncate(rows);
        self.trajectory.truncate(rows);
    }
}

fn check_names(columns: &[ExtraColumn]) -> Result<(), SystemError> {
    let mut names: HashSet<&str> = FIXED.iter().map(|column| column.name).collect();
    match columns.iter().find(|column| !names.insert(&column.name)) {
        Some(ExtraColumn { name, .. }) => {
            Err(SystemError::DuplicateSensor { name: name.to_owned() })
        }
        None => Ok(()),
    }
}

fn coordinates(model: &System) -> impl Iterator<Item = f64> + '_ {
    model.control_points().flatten().flat_map(|point| [point.x, point.y])
}

fn scales(scene: &Scene, model: &System) -> DriftScales {
    let longest = scene.longest_beam().unwrap_or(0.0);
    let distances = model.control_points().flatten().map(|point| point.norm());
    DriftScales {
        mass: model.total_mass(),
        // The length scale is the radius of gyration of the longest beam. Distances from the origin above ten beam lengths replace it.
        length: distances.fold(longest / 12_f64.sqrt(), |length, distance| {
            if distance > 10.0 * longest { length.max(distance) } else { length }
        }),
        rounding_energy: scene.rounding_energy(),
    }
}
