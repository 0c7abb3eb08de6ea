//! Tests that vector instructions of any width give identical results.

use pulp::Arch;

use super::*;
use crate::beams::span_loops::LoopRange;
use proptest::prelude::*;

const TANGENT: Collocation =
    Collocation { configuration: 0.4, stress: 0.6, rotations: RotationIncrement::TangentScaled };

fn linearised<const N: usize>(
    arch: Arch,
    beam: &DiscreteBeam<N>,
    moved: &[Movement],
) -> (Vec<u64>, Vec<SpanGroup<N>>) {
    let (mut groups, mut forces) = (beam.groups.clone(), vec![[0.0; 3]; moved.len()]);
    let mut found = Vec::new();
    let mut tangent = |_: usize, entries: &[f64]| found.extend(entries.iter().map(|x| x.to_bits()));
    let iterate = SpanInputs { section: &beam.section, at: TANGENT, movements: moved, weight: 0.7 };
    let forces_from = ForcesFrom { first: 0, forces: &mut forces };
    let work = Linearisation { iterate, forces: forces_from, tangent: &mut tangent };
    arch.dispatch(LoopRange { groups: &mut groups, work });
    found.extend(forces.as_flattened().iter().map(|x| x.to_bits()));
    (found, groups)
}

fn assert_same<const N: usize>(mesh: &Mesh, movements: &[f64]) {
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 3e3,
        bending_stiffness: 70.0,
        mass_per_length: 1.0,
        rotary_inertia: 0.3,
    };
    let count = mesh.basis().functions();
    let points = (0..count).map(|i| Vec2::new(i as f64, 0.05 * (i * i) as f64)).collect();
    let mut beam = DiscreteBeam::<N>::new(mesh, &section.into(), count as f64, points).unwrap();
    let mut movements = movements.iter().cycle();
    for _ in 0..2 {
        let moved: Vec<Movement> =
            (0..count).map(|_| std::array::from_fn(|_| *movements.next().unwrap())).collect();
        let (scalar, _) = linearised(Arch::Scalar, &beam, &moved);
        let (vectors, groups) = linearised(Arch::new(), &beam, &moved);
        assert!(scalar == vectors, "{N} functions");
        beam.groups = groups;
        beam.correct_section_forces(&moved);
        beam.advance(&moved, RotationIncrement::TangentScaled);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn beam_tangent_is_bit_identical_without_vector_instructions(
        movements in prop::collection::vec(-0.05..0.05_f64, 97),
    ) {
        assert_same::<2>(&Mesh::lagrange(5, 1).unwrap(), &movements);
        assert_same::<3>(&Mesh::bspline(5, 2, 1).unwrap(), &movements);
        assert_same::<4>(&Mesh::bspline(5, 3, 2).unwrap(), &movements);
        assert_same::<4>(&Mesh::lagrange(3, 3).unwrap(), &movements);
        assert_same::<5>(&Mesh::bspline(5, 4, 3).unwrap(), &movements);
        assert_same::<6>(&Mesh::bspline(5, 5, 4).unwrap(), &movements);
    }
}
