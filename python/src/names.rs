//! Names of objects in the place of objects: `"rod.end"` in the call `sim.position("rod.end")`.

use withy::script::bindings::catalog::Catalog;
use withy::script::bindings::kind::Kind;

/// Suffix of the methods of scenes that return the object with a name, such as `beam_named`.
const FINDER_SUFFIX: &str = "_named";

/// Methods of a scene that return the object with a name.
pub struct Finders {
    scene: &'static str,
    /// Types of the objects, and names of the methods.
    methods: Vec<(&'static str, &'static str)>,
}

impl Finders {
    /// Finders for the methods of a type; `None` if its values have no scene.
    pub fn of(catalog: &Catalog, receiver: &str) -> Option<Self> {
        let scene = match receiver {
            "scene" => "a0",
            _ => catalog
                .members(receiver)
                .iter()
                .any(|row| row.name == "scene")
                .then_some("a0.scene")?,
        };
        let named = |name: &'static str| Some((name.strip_suffix(FINDER_SUFFIX)?, name));
        let methods = catalog.members("scene").iter().filter_map(|row| named(row.name)).collect();
        Some(Self { scene, methods })
    }

    /// Returns true if a parameter of this kind also accepts the name of an object.
    pub fn accept(&self, kind: &Kind) -> bool {
        !kind.takes("text") && !self.methods_for(kind).is_empty()
    }

    /// Statement that replaces the name in a variable by the object for a parameter of this kind; empty for other texts.
    /// If several types are accepted, an unknown name has the error of the first of them.
    pub fn statement(&self, kind: &Kind, variable: &str) -> String {
        if !self.accept(kind) {
            return String::new();
        }
        let replace = |method: &str| format!("{variable} = {}.{method}({variable}); ", self.scene);
        let or_earlier =
            |earlier: String, later: String| format!("try {{ {later}}} catch {{ {earlier}}} ");
        let statements = self.methods_for(kind).into_iter().map(replace);
        statements.reduce(or_earlier).unwrap_or_default()
    }

    fn methods_for(&self, kind: &Kind) -> Vec<&'static str> {
        match kind {
            Kind::Object(of) => {
                let methods = self.methods.iter().filter(|(object, _)| *object == of.name());
                methods.map(|(_, method)| *method).collect()
            }
            Kind::Either(kinds) => kinds.iter().flat_map(|kind| self.methods_for(kind)).collect(),
            _ => Vec::new(),
        }
    }
}
