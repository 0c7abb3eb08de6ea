//! Sensors that are recorded in every history of a scene without a request.

use super::Scene;
use crate::geometry::Vec2;
use crate::loads::LoadKind;
use crate::system::elements::{DriveKind, Element, Spring};
use crate::system::sensors::quantities::{
    COLUMNS_OF_LOADS, COLUMNS_OF_MOVES, COLUMNS_OF_OBSTACLES, COLUMNS_OF_SLIDERS,
    COLUMNS_OF_SPRINGS, COLUMNS_OF_TORSION_SPRINGS, DISSIPATED, FLIGHT_GAP, OBSTACLE_FRICTION,
    REST_ANGLE, REST_LENGTH, SLEEVE_COUPLE, SLIDER_FRICTION, STORED, TORQUE, WORK,
};
use crate::system::{Sensor, SensorSource};

impl Scene {
    pub(crate) fn history_sensors(&self) -> Vec<Sensor> {
        let (mut all, mut others, mut winds) = (Vec::new(), Vec::new(), Vec::new());
        for (at, slider) in self.sliders.iter().enumerate() {
            let friction = (slider.has_friction()).then_some(&SLIDER_FRICTION);
            let gap = slider.side().map(|_| &FLIGHT_GAP);
            let couple = slider.is_sleeve().then_some(&SLEEVE_COUPLE);
            let own = COLUMNS_OF_SLIDERS.iter().chain(couple).chain(friction).chain(gap);
            all.extend(own.map(|own| Sensor::of(&slider.name, own, SensorSource::Slider(at))));
        }
        let stores = self.springs().next().is_some()
            || self.obstacles().next().is_some()
            || self.contacts().next().is_some();
        let dissipates = stores || self.dissipating().next().is_some();
        let sums = [(stores, &STORED), (dissipates, &DISSIPATED)].into_iter();
        all.extend(sums.filter(|(is_there, _)| *is_there).map(|(_, quantity)| {
            let (name, source) = (quantity.name.to_owned(), SensorSource::Scene);
            Sensor { name, source, quantity }
        }));
        for (at, element) in self.internal_forces().enumerate() {
            let source = SensorSource::InternalForce(at);
            match element {
                Element::Spring(spring) => all.extend(columns_of_spring(spring, source)),
                Element::Damping(damping) => {
                    others.push(Sensor::in_sum(&DISSIPATED, &damping.name, source));
                }
                Element::Drag(drag) => {
                    others.push(Sensor::in_sum(&DISSIPATED, &drag.name, source));
                    let has_wind = drag.wind != Vec2::zeros();
                    winds.extend(has_wind.then(|| Sensor::in_sum(&WORK, &drag.name, source)));
                }
                Element::Obstacle(obstacle) => {
                    let friction = (obstacle.friction > 0.0).then_some(&OBSTACLE_FRICTION);
                    let own = COLUMNS_OF_OBSTACLES.iter().chain(friction);
                    all.extend(own.map(|own| Sensor::of(&obstacle.name, own, source)));
                    all.push(Sensor::in_sum(&STORED, &obstacle.name, source));
                    others.push(Sensor::in_sum(&DISSIPATED, &obstacle.name, source));
                }
                Element::Contact(contact) => {
                    let friction = (contact.friction > 0.0).then_some(&OBSTACLE_FRICTION);
                    let own = COLUMNS_OF_OBSTACLES.iter().chain(friction);
                    all.extend(own.map(|own| Sensor::of(&contact.name, own, source)));
                    all.push(Sensor::in_sum(&STORED, &contact.name, source));
                    others.push(Sensor::in_sum(&DISSIPATED, &contact.name, source));
                }
                Element::PointMass(_) | Element::Load(_) => (),
            }
        }
        all.append(&mut others);
        let sliders = self.sliders.iter().enumerate().filter(|(_, slider)| slider.dissipates());
        all.extend(sliders.map(|(at, slider)| {
            Sensor::in_sum(&DISSIPATED, &slider.name, SensorSource::Slider(at))
        }));
        for (at, drive) in self.drives.iter().enumerate() {
            let own = drive.motions().map(|(component, _)| match drive.kind {
                DriveKind::Move => &COLUMNS_OF_MOVES[component as usize],
                DriveKind::Motor => &TORQUE,
            });
            let source = SensorSource::Drive(at);
            all.extend(own.map(|own| Sensor::of(&drive.name, own, source)));
            all.push(Sensor::in_sum(&WORK, &drive.name, source));
        }
        for (at, load) in self.loads().enumerate() {
            let Some(name) = &load.title else { continue };
            let [force, line, torque] = &COLUMNS_OF_LOADS;
            let own = match load.kind {
                LoadKind::Force { .. } => force,
                LoadKind::Line { .. } => line,
                LoadKind::Moment { .. } => torque,
            };
            let source = SensorSource::Load(at);
            all.extend([Sensor::of(name, own, source), Sensor::in_sum(&WORK, name, source)]);
        }
        all.append(&mut winds);
        all.extend_from_slice(&self.sensors);
        all
    }
}

fn columns_of_spring(spring: &Spring, source: SensorSource) -> Vec<Sensor> {
    let (own, rest) = match spring.kind.is_angle() {
        false => (&COLUMNS_OF_SPRINGS, &REST_LENGTH),
        true => (&COLUMNS_OF_TORSION_SPRINGS, &REST_ANGLE),
    };
    let [rest, work] = [rest, &WORK].map(|column| spring.rest.as_ref().map(|_| column));
    let own = own.iter().chain(rest).map(|column| Sensor::of(&spring.name, column, source));
    let sums = [&STORED, &DISSIPATED].into_iter().chain(work);
    own.chain(sums.map(|sum| Sensor::in_sum(sum, &spring.name, source))).collect()
}
