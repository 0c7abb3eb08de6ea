//! Names of the sensors that a scene records on request.

use std::borrow::Cow;

use super::Scene;
use crate::beams::{BodyIndex, Station};
use crate::joints::{Joint, JointKind, Partner, Slider};
use crate::system::errors::check_name;
use crate::system::sensors::quantities::{
    OF_BODIES, OF_CALLER, OF_JOINTS, OF_PARTICLES, OF_POINTS, OF_SLIDERS, OF_STATIONS, POWER,
    QuantityReader,
};
use crate::system::{Element, Quantity, RigidBodyDefinition, Sensor, SensorSource, SystemError};

/// Word for a sensor in messages: each sensor is a column of the history.
const COLUMN: &str = "column";

/// Ending of the sensor of the x coordinate, which only stations have.
const X_COLUMN: &str = ".x";

struct Place<'s> {
    object: Cow<'s, str>,
    suffix: Cow<'s, str>,
    source: SensorSource,
    quantities: &'static [Quantity],
}

impl Place<'_> {
    fn why_no_quantity(&self) -> String {
        let Self { object, quantities, .. } = self;
        let names: Vec<&str> = quantities.iter().map(|quantity| quantity.name).collect();
        let names = names.join(", ");
        let in_every_history = |columns: &str| {
            format!(
                "{columns} '{object}' have columns in every history and need no recording; its other quantities are {names}"
            )
        };
        match self.source {
            SensorSource::Body(_) => format!(
                "a whole beam has {names}; its places have {object}.start.x, {object}.end.x, {object}[s].x and so on"
            ),
            SensorSource::Slider(_) => {
                in_every_history("position, speed and force (of a sleeve also couple) of slider")
            }
            SensorSource::Drive(_) => in_every_history("work and forces of drive"),
            SensorSource::Load(_) => in_every_history("work and value of load"),
            _ => format!("its last part must be one of {names}"),
        }
    }
}

impl Scene {
    /// Records a built-in quantity, given by its name.
    ///
    /// # Errors
    /// Fails if the object, the location or the quantity does not exist, or if the quantity is already recorded.
    pub fn record(&mut self, name: &str) -> Result<(), SystemError> {
        self.check_column(name)?;
        let (source, quantity) = self.find_sensor(name)?;
        if let (SensorSource::Station(station), QuantityReader::Angle) = (source, quantity.read)
            && let Some(beam) = station.beam()
        {
            self.station(beam, station.arc_length)?;
        }
        self.sensors.push(Sensor { name: name.to_owned(), source, quantity });
        Ok(())
    }

    /// Adds a column that the caller fills after every row of the history.
    ///
    /// # Errors
    /// Fails if the column exists, or if the name is invalid or contains a comma or a quotation mark.
    pub fn record_outside(&mut self, name: &str) -> Result<(), SystemError> {
        check_name(COLUMN, name)?;
        self.check_column(name)?;
        let (source, quantity) = (SensorSource::External, &OF_CALLER);
        self.sensors.push(Sensor { name: name.to_owned(), source, quantity });
        Ok(())
    }

    fn check_column(&self, name: &str) -> Result<(), SystemError> {
        if name.contains([',', '"']) {
            let why = "it has a comma or a quotation mark";
            return Err(SystemError::Unnamed { kind: COLUMN, name: name.to_owned(), reason: why });
        }
        match self.sensors.iter().any(|sensor| sensor.name == name) {
            true => Err(SystemError::DuplicateSensor { name: name.to_owned() }),
            false => Ok(()),
        }
    }

    /// Names of all sensors that can be recorded. Sensors along beams are listed for the start, middle and end only.
    pub fn sensor_names(&self) -> Vec<String> {
        let places = self.places().into_iter();
        let names = places.flat_map(|Place { object, suffix, quantities, .. }| {
            quantities.iter().map(move |quantity| format!("{object}{suffix}.{}", quantity.name))
        });
        names.collect()
    }

    /// Station with a name as in the names of sensors, such as `rod.end`, `rod[0.5]`, `bead` or `hub.pin`; `None` if there is none.
    pub fn station_named(&self, name: &str) -> Option<Station> {
        match self.find_sensor(&format!("{name}{X_COLUMN}")) {
            Ok((SensorSource::Station(station), _)) => Some(station),
            _ => None,
        }
    }

    /// Names of all stations. Of each beam, only the start, middle and end are listed.
    pub fn station_names(&self) -> Vec<String> {
        let names = self.sensor_names().into_iter();
        names.filter_map(|name| Some(name.strip_suffix(X_COLUMN)?.to_owned())).collect()
    }

    /// Names of the joints for sensors, in the order of the joints: `hinge1`, `clamp1`, `hinge2`, `rigid1`, `support1`.
    /// The clamp of the holder of a sleeve on the ground has the name of the holder.
    pub fn joint_names(&self) -> Vec<String> {
        let mut counts = [0; 4];
        let name = |joint: &Joint| {
            if let Some(holder) = self.sleeve_holder(joint) {
                return holder;
            }
            let (kind, at) = match (joint.kind, &joint.partner) {
                (JointKind::Hinge, _) => ("hinge", 0),
                (JointKind::Rigid, Partner::Ground) => ("clamp", 1),
                (JointKind::Rigid, Partner::Station(_)) => ("rigid", 2),
                (
                    JointKind::Support(_)
                    | JointKind::InclinedRoller(_)
                    | JointKind::InclinedGuide(_),
                    _,
                ) => ("support", 3),
            };
            counts[at] += 1;
            format!("{kind}{}", counts[at])
        };
        self.joints.iter().map(name).collect()
    }

    /// Name of the holder of a sleeve that a joint fixes to the ground; `None` for other joints.
    fn sleeve_holder(&self, joint: &Joint) -> Option<String> {
        let of_joint = |sleeve: &&Slider| sleeve.is_sleeve() && sleeve.slave == joint.station;
        let holder = format!("{}_holder", self.sliders.iter().find(of_joint)?.name);
        let is_holder = |body: &RigidBodyDefinition| body.name == holder;
        self.rigid_bodies.iter().any(is_holder).then_some(holder)
    }

    fn places(&self) -> Vec<Place<'_>> {
        let mut all = Vec::new();
        let mut add = |object, suffix, source, quantities| {
            all.push(Place { object, suffix, source, quantities });
        };
        for (at, beam) in self.beams.iter().enumerate() {
            let (name, length) = (&*beam.name, beam.axis.length());
            for (suffix, s) in [(".start", 0.0), (".middle", 0.5 * length), (".end", length)] {
                let station = SensorSource::Station(Station::on_beam(at, s));
                add(name.into(), suffix.into(), station, &OF_STATIONS[..]);
            }
            let body = SensorSource::Body(BodyIndex::Beam(at));
            add(name.into(), "".into(), body, &OF_BODIES);
        }
        for (at, particle) in self.particles.iter().enumerate() {
            let (name, station) = (&*particle.name, Station::on_particle(at));
            let quantities = &OF_STATIONS[..OF_PARTICLES];
            add(name.into(), "".into(), SensorSource::Station(station), quantities);
            let body = SensorSource::Body(BodyIndex::Particle(at));
            add(name.into(), "".into(), body, &OF_BODIES);
        }
        for (at, body) in self.rigid_bodies.iter().enumerate() {
            let name = &*body.name;
            let own =
                |(point, _): &(String, _)| Some((format!(".{point}"), body.control_point(point)?));
            let points = body.points.iter().filter_map(own);
            for (suffix, point) in std::iter::once((String::new(), 0)).chain(points) {
                let station = SensorSource::Station(Station::on_rigid_body(at, point));
                add(name.into(), suffix.into(), station, &OF_STATIONS[..OF_POINTS]);
            }
            let body = SensorSource::Body(BodyIndex::Rigid(at, 0));
            add(name.into(), "".into(), body, &OF_BODIES);
        }
        for (at, joint) in self.joint_names().into_iter().enumerate() {
            add(joint.into(), "".into(), SensorSource::Joint(at), &OF_JOINTS);
        }
        for (at, slider) in self.sliders.iter().enumerate() {
            add((&*slider.name).into(), "".into(), SensorSource::Slider(at), &OF_SLIDERS);
        }
        for (at, drive) in self.drives.iter().enumerate() {
            add((&*drive.name).into(), "".into(), SensorSource::Drive(at), &POWER);
        }
        for (at, element) in self.internal_forces().enumerate() {
            if let Element::Spring(spring) = element
                && spring.rest.is_some()
            {
                let source = SensorSource::InternalForce(at);
                add((&*spring.name).into(), "".into(), source, &POWER);
            }
        }
        for (at, load) in self.loads().enumerate() {
            if let Some(name) = load.title.as_deref() {
                add(name.into(), "".into(), SensorSource::Load(at), &POWER);
            }
        }
        all
    }

    fn find_sensor(&self, name: &str) -> Result<(SensorSource, &'static Quantity), SystemError> {
        let refused = |why: String| SystemError::NoSensor { name: name.to_owned(), reason: why };
        let of = |known: &str| {
            let rest = name.strip_prefix(known)?;
            rest.starts_with(['.', '[']).then_some(rest)
        };
        let mut places = self.places();
        let named =
            places.iter().filter_map(|place| Some((place.object.clone(), of(&place.object)?)));
        let longest = named.min_by_key(|(_, rest)| rest.len());
        let Some((object, rest)) = longest else {
            let spring = self.springs().find(|spring| of(&spring.name).is_some());
            return Err(refused(match spring {
                Some(spring) => format!(
                    "springs such as '{}' have columns in every history and need no recording",
                    spring.name
                ),
                None => "it must begin with the name of a beam, particle, body, slider, drive, named load or joint (hinge1, clamp1, rigid1) of the scene".to_owned(),
            }));
        };
        places.retain(|place| place.object == object);
        if let SensorSource::Station(Station { body: BodyIndex::Beam(beam), .. }) = places[0].source
            && let Some(inside) = rest.strip_prefix('[')
        {
            let length = self.beams[beam].axis.length();
            let place = place_inside(object.clone(), beam, inside, length);
            places.push(place.ok_or_else(|| {
                refused(format!("write {object}[s].x with s from 0 to {length}"))
            })?);
        }
        let wanted = |place: &Place| rest.strip_prefix(&*place.suffix)?.strip_prefix('.');
        let matching = places.iter().filter(|place| wanted(place).is_some());
        let suffix = matching.map(|place| place.suffix.len()).max().unwrap_or(0);
        places.retain(|place| place.suffix.len() == suffix && rest.starts_with(&*place.suffix));
        let of_place = |place: &Place| {
            let wanted = wanted(place)?;
            let quantity = place.quantities.iter().find(|quantity| quantity.name == wanted)?;
            Some((place.source, quantity))
        };
        places.iter().find_map(of_place).ok_or_else(|| refused(places[0].why_no_quantity()))
    }
}

fn place_inside<'s>(
    object: Cow<'s, str>,
    beam: usize,
    rest: &str,
    length: f64,
) -> Option<Place<'s>> {
    let (number, _) = rest.split_once("].")?;
    let s: f64 = number.trim_matches(' ').parse().ok()?;
    let source = SensorSource::Station(Station::on_beam(beam, s));
    let suffix = format!("[{number}]").into();
    (0.0..=length).contains(&s).then_some(Place {
        object,
        suffix,
        source,
        quantities: &OF_STATIONS,
    })
}
