//! Tests of building templates.

use super::*;
use crate::error::ErrorKind;
use crate::solver::constraint::{Anchor, Area, Bend, MinDistance, Rope};
use crate::solver::muscle::Scaled;

/// Discs at (0, 0) and (0, 2).
fn two_nodes() -> TemplateBuilder {
    let mut builder = Template::builder();
    builder.node(Node::disc(Vec2::ZERO, 1.0, 0.5));
    builder.node(Node::disc(Vec2::new(0.0, 2.0), 1.0, 0.5));
    builder
}

#[test]
fn links_rest_at_the_present_distance() {
    let mut builder = two_nodes();
    builder.link(0, 1, 1e-4);
    let template = builder.build().unwrap();
    let link = Distance { a: 0, b: 1, rest_length: 2.0, compliance: 1e-4, damping: 0.0 };
    assert_eq!(template.constraints(), [link.into()]);
    assert_eq!(template.extent(), 2.5);
}

#[test]
fn constraints_are_sorted_by_kind_with_limits_last() {
    let mut builder = two_nodes();
    let rope = |max_length| Constraint::from(Rope { a: 0, b: 1, max_length });
    let distance = |rest_length| Distance { a: 0, b: 1, rest_length, compliance: 0.0, damping: 0.0 }.into();
    for constraint in [rope(3.0), distance(2.0), rope(2.5), distance(1.0)] {
        builder.constraint(constraint);
    }
    let template = builder.build().unwrap();
    assert_eq!(template.constraints(), [distance(2.0), distance(1.0), rope(3.0), rope(2.5)]);
}

#[test]
fn a_muscle_stays_one_when_constraints_are_sorted() {
    let mut builder = two_nodes();
    let [slow, fast] = [0.5, 0.8].map(|active| builder.channel([1.0, active]));
    builder.muscle(fast, Rope { a: 0, b: 1, max_length: 3.0 }).link(0, 1, 0.0);
    builder.muscle(slow, Distance { a: 0, b: 1, rest_length: 1.0, compliance: 0.0, damping: 0.0 });
    let template = builder.build().unwrap();
    let muscle = |constraint, channel| Muscle { constraint, channel };
    assert_eq!((&template.muscles[..], template.channels().len()), (&[muscle(1, slow), muscle(2, fast)][..], 2));
    assert!(matches!(template.constraints()[2], Constraint::Rope(_)));
}

#[test]
fn yielding_links_have_rows_after_the_channels_and_may_be_muscles() {
    let mut builder = two_nodes();
    let channel = builder.channel([1.5, 0.5]);
    let link = YieldingDistance::from(Distance { a: 0, b: 1, rest_length: 1.0, compliance: 1e-3, damping: 0.0 });
    builder.muscle(channel, Rope { a: 0, b: 1, max_length: 3.0 }).constraint(link).link(0, 1, 0.0);
    builder.muscle(channel, link);
    let template = builder.build().unwrap();
    let scaled = |constraint, channel, link| Scaled { constraint, channel, link };
    let (muscle, rope) = (scaled(2, Some(channel), Some(2)), scaled(3, Some(channel), None));
    assert_eq!(template.scaled(), [scaled(1, None, Some(1)), muscle, rope]);
    assert_eq!((template.rest_state(), template.yielding_links().count()), (vec![1.5, 0.0, 0.0], 2));
    assert!(template.yields() && !two_nodes().build().unwrap().yields());
}

/// Changes two discs and expects that this field is refused.
fn refuses(change: impl FnOnce(&mut TemplateBuilder), field: &str) {
    let mut builder = two_nodes();
    change(&mut builder);
    assert_eq!(builder.build().unwrap_err().field(), field);
}

#[test]
fn bad_nodes_and_outlines_are_refused_by_name() {
    refuses(|b| _ = b.node(Node::disc(Vec2::NAN, 1.0, 0.5)), "nodes[2].position.x");
    refuses(|b| _ = b.node(Node::disc(Vec2::ZERO, 0.0, 0.5)), "nodes[2].mass");
    refuses(|b| _ = b.node(Node::disc(Vec2::ZERO, 1.0, -0.5)), "nodes[2].radius");
    refuses(|b| _ = b.outline(&[0, 1]), "outline");
    assert!(matches!(Template::builder().build().unwrap_err().kind(), ErrorKind::BadReference { .. }));
}

#[test]
fn bad_constraints_are_refused_by_name() {
    refuses(|b| _ = b.link(0, 7, 0.0), "constraints[0].a");
    refuses(|b| _ = b.link(1, 1, 0.0), "constraints[0].a");
    refuses(|b| _ = b.link(0, 1, f32::NAN), "constraints[0].compliance");
    refuses(|b| _ = b.constraint(Rope { a: 0, b: 1, max_length: -1.0 }), "constraints[0].max_length");
    refuses(|b| _ = b.constraint(MinDistance { a: 0, b: 9, min_length: 1.0 }), "constraints[0].a");
    let anchor = Anchor { node: 0, anchor: 1, rest_length: 2.0, max_length: 1.0, compliance: 0.0 };
    refuses(|b| _ = b.constraint(anchor), "constraints[0].max_length");
    let area = Area { ring: vec![0, 1, 1], rest_area: 1.0, compliance: 0.0, is_upper_bound: false };
    refuses(|b| _ = b.constraint(area), "constraints[0].ring");
}

#[test]
fn bad_yielding_links_are_refused_by_name() {
    let spring = Distance { a: 0, b: 1, rest_length: 1.0, compliance: 1e-3, damping: 0.0 };
    let refuses = |change: fn(&mut YieldingDistance), field: &str| {
        let mut link = YieldingDistance::from(spring);
        change(&mut link);
        refuses(|b| _ = b.constraint(link), &format!("constraints[0].{field}"));
    };
    refuses(|link| link.b = 7, "a");
    refuses(|link| link.rest_length = 0.0, "rest_length");
    refuses(|link| link.compliance = 0.0, "compliance");
    refuses(|link| link.damping = 11.0, "damping");
    refuses(|link| link.yield_strain = -0.1, "yield_strain");
    refuses(|link| link.flow_rate = 101.0, "flow_rate");
    refuses(|link| link.max_plastic_strain = f32::INFINITY, "max_plastic_strain");
    refuses(|link| link.breaking_strain = 0.0, "breaking_strain");
    refuses(|link| link.breaking_strain = f32::NAN, "breaking_strain");
}

/// A bend over both discs and a third one, which is added.
fn bend(builder: &mut TemplateBuilder, angle: f32, compliance: f32) -> Bend {
    let third = builder.node(Node::disc(Vec2::Y, 1.0, 0.5));
    Bend::new([0, 1, third], angle, compliance)
}

#[test]
fn bad_bends_are_refused_by_name() {
    for (angle, compliance, field) in
        [(f32::NAN, 0.0, "constraints[0].rest_turn"), (0.0, -1.0, "constraints[0].compliance")]
    {
        let add = |b: &mut TemplateBuilder| {
            let bend = bend(b, angle, compliance);
            b.constraint(bend);
        };
        refuses(add, field);
    }
    refuses(|b| _ = b.constraint(Bend::new([0, 1, 2], 0.0, 0.0)), "constraints[0].a");
}

#[test]
fn bad_muscles_and_propulsions_are_refused_by_name() {
    refuses(|b| _ = b.channel([0.0, 1.0]), "channels[0].rest");
    refuses(|b| _ = b.channel([1.0, f32::NAN]), "channels[0].active");
    refuses(|b| _ = b.muscle(0, Rope { a: 0, b: 1, max_length: 1.0 }), "muscles");
    let bending = |b: &mut TemplateBuilder| {
        let bend = bend(b, 0.0, 0.0);
        let channel = b.channel([1.0, 2.0]);
        b.muscle(channel, bend);
    };
    refuses(bending, "muscles");
    let propulsion = |speed, max_acceleration| Propulsion { speed, max_acceleration };
    refuses(|b| _ = b.propulsion(propulsion(-1.0, 0.0)), "propulsion.speed");
    refuses(|b| _ = b.propulsion(propulsion(1.0, f32::INFINITY)), "propulsion.max_acceleration");
}

#[test]
fn bad_cuts_are_refused_by_name() {
    let halves = |one: &[u32], other: &[u32]| [one, other].map(|slots| Half::of(slots.iter().copied()));
    for [one, other] in [[&[0][..], &[][..]], [&[0], &[0]], [&[0], &[1, 1]], [&[0], &[2]], [&[0, 1], &[]]] {
        refuses(|b| _ = b.cut(halves(one, other)), "cut");
    }
    let [left, right] = halves(&[0], &[1]);
    refuses(|b| _ = b.cut([left.clone(), right.clone().scaled(f32::NAN)]), "cut[1].scale");
    refuses(|b| _ = b.cut([left.clone().named("a\tb"), right.clone()]), "cut[0].template");
    let anchored = |b: &mut TemplateBuilder| {
        b.node(Node::fixed(Vec2::Y));
        b.cut(halves(&[0, 2], &[1]));
    };
    refuses(anchored, "cut");
}

#[test]
fn a_body_may_follow_goals_and_divide() {
    let mut builder = two_nodes();
    let swims = Propulsion { speed: 1.0, max_acceleration: 2.0 };
    let halves = [Half::of([1]).named("bud").scaled(0.5), Half::of([0])];
    builder.cut(halves.clone()).propulsion(swims);
    let template = builder.build().unwrap();
    assert_eq!((template.cut(), template.propulsion()), (Some(&halves), Some(swims)));
    let mut other = two_nodes();
    other.propulsion(swims).cut(halves);
    assert_eq!(other.build().unwrap(), template);
    assert_eq!(two_nodes().build().unwrap().cut(), None);
}
