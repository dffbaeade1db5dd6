//! What the mouse does in a simulation: steer, drag, push, spawn, remove, follow, build.

use super::building::{Building, draw_fields, draw_joints};
use super::ghost::Ghost;
use super::spawns::{SPAWNS, controller, refusal};
use crate::camera::Camera;
use crate::draw::palette::{HALO, READY, fade};
use crate::guide::identify::{name_at, organism_at};
use crate::guide::{self, Entry};
use crate::input::Input;
use crate::stage::Stage;
use crate::ui::font::TextSize;
use crate::ui::pen::Pen;
use crate::words::{self, Key};
use microsim_core::glam::Vec2;
use microsim_core::{Intent, OrganismId, Placement, View, World};

/// How near the cursor must be to something, pixels.
const NEAR: f32 = 12.0;
/// How fast dragged things close in on the cursor, 1/s, and how fast they get at most, units/s.
const DRAG_RATE: f32 = 6.0;
const DRAG_SPEED: f32 = 30.0;
/// Share of the wanted change of velocity in each step: constraints need time to pass it on.
const DRAG_SHARE: f32 = 0.8;
/// Radius in which things are pushed, units, and the change of their velocity in each step, units/s.
const PUSH_RADIUS: f32 = 9.0;
const PUSH: f32 = 1.6;

/// What the mouse does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Tool {
    #[default]
    Steer,
    Drag,
    Push,
    Spawn,
    Remove,
    Follow,
    Ask,
    Look,
    Join,
    Wall,
    Field,
}

impl Tool {
    /// All of them, with their labels in the panel.
    pub(super) const ALL: [(Self, Key); 11] = [
        (Self::Steer, Key::ToolSteer),
        (Self::Drag, Key::ToolDrag),
        (Self::Push, Key::ToolPush),
        (Self::Spawn, Key::ToolSpawn),
        (Self::Remove, Key::ToolRemove),
        (Self::Follow, Key::ToolFollow),
        (Self::Ask, Key::ToolAsk),
        (Self::Look, Key::ToolLook),
        (Self::Join, Key::ToolJoin),
        (Self::Wall, Key::ToolWall),
        (Self::Field, Key::ToolField),
    ];
}

impl Tool {
    /// Whether its use changes the world at once, and so can be undone.
    pub(super) fn is_act(self) -> bool {
        matches!(self, Self::Drag | Self::Push | Self::Spawn | Self::Remove) || self.builds()
    }

    /// Whether it builds something, of which there is more or less after that.
    pub(super) fn builds(self) -> bool {
        matches!(self, Self::Join | Self::Wall | Self::Field)
    }

    /// Whether it does something only while time passes.
    pub(super) fn needs_time(self) -> bool {
        matches!(self, Self::Steer | Self::Drag | Self::Push)
    }
}

/// The tool in hand.
#[derive(Debug, Default)]
pub(super) struct Tools {
    pub tool: Tool,
    spawn: usize,
    grasped: Option<OrganismId>,
    /// Where the cursor is in the room while the button is down.
    hand: Option<Vec2>,
    /// What was asked about.
    asked: Option<&'static Entry>,
    /// The point of the room that follows the cursor while looking around.
    grip: Option<Vec2>,
    ghost: Ghost,
    building: Building,
    /// Where the cursor is in the room.
    cursor: Vec2,
}

impl Tools {
    /// What a tool would put into the room.
    pub(super) fn value(&self, tool: Tool) -> Option<Key> {
        match tool {
            Tool::Spawn => Some(SPAWNS[self.spawn].0),
            Tool::Field => Some(self.building.field_name()),
            _ => None,
        }
    }

    /// Takes a tool in hand. Chosen again, one that puts things in changes to the next thing, or the one before.
    pub(super) fn choose(&mut self, tool: Tool, is_back: bool) {
        match tool {
            Tool::Spawn if self.tool == tool => self.change_spawn(is_back),
            Tool::Field if self.tool == tool => self.building.change_field(),
            _ => {}
        }
        self.tool = tool;
        self.building.let_go();
    }

    /// Whether the button was held and no longer is.
    pub(super) fn ends(&self, input: &Input) -> bool {
        self.hand.is_some() && !input.is_held
    }

    /// The next thing to put into the room, or the one before.
    fn change_spawn(&mut self, is_back: bool) {
        self.spawn = (self.spawn + if is_back { SPAWNS.len() - 1 } else { 1 }) % SPAWNS.len();
    }

    /// Uses the tool as the mouse says. Returns what went wrong, or why it does nothing.
    pub(super) fn use_on(
        &mut self,
        stage: &mut Stage,
        camera: &Camera,
        input: &Input,
        is_on_panel: bool,
        digests: bool,
    ) -> Option<String> {
        let at = camera.to_room(input.cursor);
        let (begins, ends) = (input.is_clicked && !is_on_panel, self.ends(input));
        self.cursor = at;
        let goes_on = input.is_held && (begins || self.hand.is_some());
        self.hand = goes_on.then_some(at);
        if !goes_on {
            self.grasped = None;
        }
        let goal = self.hand.filter(|_| self.tool == Tool::Steer).and_then(|at| Intent::toward(at).ok());
        stage.steer(goal.unwrap_or(Intent::REST).digesting(digests));
        match begins {
            true => self.begin(stage, camera, at),
            false if ends => {
                let told = self.building.end_wall(stage.world_mut(), at, NEAR / camera.scale());
                told.map(|key| words::text(key).to_owned())
            }
            false => None,
        }
    }

    /// Begins to use the tool at a point. Returns what went wrong, or why it does nothing.
    fn begin(&mut self, stage: &mut Stage, camera: &Camera, at: Vec2) -> Option<String> {
        let within = NEAR / camera.scale();
        let found = organism_at(stage.world(), at, within);
        let told = |key| Some(words::text(key).to_owned());
        match (self.tool, found) {
            (Tool::Spawn, _) => return self.put_in(stage, at).err(),
            (Tool::Ask, _) => self.asked = guide::find(name_at(stage.world().view(), at, within)),
            // Who follows nobody begins with the one at hand.
            (Tool::Steer, Some(_)) if stage.player().is_none() => stage.set_player(found),
            (Tool::Steer, None) if stage.player().is_none() => return told(Key::SandboxNobody),
            (Tool::Steer, _) if !can_crawl(stage) => return told(Key::SandboxImmobile),
            (Tool::Look, _) if camera.shows_all() => return told(Key::SandboxWhole),
            (Tool::Push, _) if stage.world().organisms_in_circle(at, PUSH_RADIUS).next().is_none() => {
                return told(Key::SandboxNothing);
            }
            (Tool::Remove | Tool::Drag, None) => return told(Key::SandboxNothing),
            (Tool::Follow, None) => {
                stage.set_player(None);
                return told(Key::SandboxFree);
            }
            (Tool::Remove, Some(id)) => {
                return stage.world_mut().remove(id).err().and_then(|_| told(Key::SandboxNothing));
            }
            (Tool::Follow, _) => stage.set_player(found),
            (Tool::Drag, _) => self.grasped = found,
            (Tool::Join, _) => return self.building.join(stage.world_mut(), at, within).and_then(told),
            (Tool::Wall, _) => self.building.begin_wall(stage.world_mut(), at, within),
            (Tool::Field, _) => return self.building.put_field(stage.world_mut(), at).and_then(told),
            _ => {}
        }
        None
    }

    /// What was asked about since this was last called.
    pub(super) fn take_asked(&mut self) -> Option<&'static Entry> {
        self.asked.take()
    }

    /// Lets go of what is held.
    pub(super) fn let_go(&mut self) {
        (self.grasped, self.hand, self.grip) = (None, None, None);
        self.building.let_go();
    }

    /// Shows what a click would put in.
    pub(super) fn foresee(&mut self, world: &World, at: Vec2, is_on_panel: bool) {
        if self.tool == Tool::Spawn && !is_on_panel {
            self.ghost.update(world, self.spawn, &SPAWNS[self.spawn].1(), at);
        } else {
            self.ghost.hide();
        }
    }

    fn put_in(&self, stage: &mut Stage, at: Vec2) -> Result<(), String> {
        let (name, spec) = SPAWNS[self.spawn];
        let placement = Placement::at(at.x, at.y).steered_by(controller(name));
        let world = stage.world_mut();
        world.spawn(&spec(), placement).map(drop).map_err(|error| refusal(name, &error))
    }

    /// Moves the view with the hand, if that is the tool; nobody is followed then.
    pub(super) fn look_around(&mut self, camera: &mut Camera) -> bool {
        if self.tool != Tool::Look {
            self.grip = None;
            return false;
        }
        match self.hand {
            Some(hand) => camera.shift(*self.grip.get_or_insert(hand) - hand),
            None => self.grip = None,
        }
        true
    }

    /// One step of the world, with what the tool does to it before.
    pub(super) fn step<'a>(&self, stage: &'a mut Stage) -> &'a World {
        match (self.tool, self.hand, self.grasped) {
            (Tool::Drag, Some(hand), Some(id)) => drag(stage.world_mut(), id, hand),
            (Tool::Push, Some(hand), _) => push_away(stage.world_mut(), hand),
            _ => {}
        }
        stage.step();
        stage.world()
    }

    /// Draws what the tool is about to do.
    pub(super) fn draw(&self, pen: &mut Pen, view: View<'_>, camera: &Camera) {
        self.ghost.draw(pen.canvas(), camera);
        draw_joints(pen.canvas(), view.world(), camera);
        self.building.draw(pen.canvas(), view.world(), camera, self.cursor);
        if self.tool == Tool::Field {
            draw_fields(pen.canvas(), view.world(), camera);
        }
        let Some(hand) = self.hand else { return };
        let (at, width) = (camera.to_screen(hand), 0.12 * pen.line(TextSize::Body));
        match self.tool {
            Tool::Push => pen.canvas().arc(at, PUSH_RADIUS * camera.scale(), width, 1.0, fade(HALO, 0.8)),
            Tool::Drag => {
                if let Some(held) = self.grasped.and_then(|id| view.organism(id)) {
                    pen.canvas().segment(camera.to_screen(held.centroid()), at, width, READY);
                }
            }
            _ => {}
        }
    }
}

fn can_crawl(stage: &Stage) -> bool {
    stage.player().and_then(|id| stage.world().view().organism(id)).is_some_and(|organism| organism.speed() > 0.0)
}

fn drag(world: &mut World, id: OrganismId, hand: Vec2) {
    let Some(centre) = world.centroid(id) else { return };
    let wanted = ((hand - centre) * DRAG_RATE).clamp_length_max(DRAG_SPEED);
    let change = (wanted - mean_velocity(world, id)) * DRAG_SHARE;
    // It may have been eaten meanwhile.
    let _ = world.push(id, change);
}

fn mean_velocity(world: &World, id: OrganismId) -> Vec2 {
    let velocities = world.view().organism(id).into_iter().flat_map(|organism| organism.particles());
    let (sum, count) = velocities.fold((Vec2::ZERO, 0.0), |(sum, count), p| (sum + p.velocity, count + 1.0));
    if count > 0.0 { sum / count } else { Vec2::ZERO }
}

fn push_away(world: &mut World, hand: Vec2) {
    let near: Vec<OrganismId> = world.organisms_in_circle(hand, PUSH_RADIUS).collect();
    for id in near {
        let away = world.centroid(id).map_or(Vec2::ZERO, |centre| (centre - hand).normalize_or_zero());
        let _ = world.push(id, away * PUSH);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::{AgarSpec, WorldConfig};

    fn stage() -> Stage {
        Stage::new("test".to_owned(), World::new(WorldConfig::default()).unwrap(), None)
    }

    #[test]
    fn everything_can_be_put_in_found_dragged_and_removed() {
        for spawn in 0..SPAWNS.len() {
            let mut stage = stage();
            let tools = Tools { tool: Tool::Spawn, spawn, ..Tools::default() };
            let at = Vec2::new(60.0, 45.0);
            tools.put_in(&mut stage, at).unwrap();
            let id = organism_at(stage.world(), at, 1.0)
                .unwrap_or_else(|| panic!("{:?}", tools.value(Tool::Spawn).unwrap()));
            let hand = Vec2::new(90.0, 45.0);
            for _ in 0..90 {
                drag(stage.world_mut(), id, hand);
                stage.step();
            }
            let moved = stage.world().centroid(id).unwrap().x - 60.0;
            // A platelet's rope lets it go so far only, and cytoplasm at rest does not like to move.
            let least = match tools.value(Tool::Spawn).unwrap() {
                Key::SpawnPlatelet => 0.3,
                Key::SpawnAmoeboid => 3.0,
                _ => 12.0,
            };
            assert!(moved > least, "{:?} {moved}", tools.value(Tool::Spawn).unwrap());
            stage.world_mut().remove(id).unwrap();
            assert_eq!(stage.world().organisms().count(), 0);
        }
    }

    #[test]
    fn tools_say_why_they_do_nothing() {
        let mut stage = stage();
        let size = stage.world().config().size;
        let camera = Camera::whole(size, Vec2::new(640.0, 360.0));
        let click = Input { cursor: Vec2::new(300.0, 200.0), is_clicked: true, is_held: true, ..Input::default() };
        for (tool, _) in Tool::ALL {
            let mut tools = Tools { tool, ..Tools::default() };
            let told = tools.use_on(&mut stage, &camera, &click, false, false);
            assert_eq!(told.is_none(), matches!(tool, Tool::Spawn | Tool::Ask) || tool.builds(), "{tool:?}: {told:?}");
            stage = super::tests::stage();
        }
        let agar = stage.world_mut().spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
        stage.set_player(Some(agar));
        let told = Tools::default().use_on(&mut stage, &camera, &click, false, false);
        assert_eq!(told.as_deref(), Some(words::text(Key::SandboxImmobile)));
        let mut near = Camera::around(0.5 * size, 30.0, size, Vec2::new(640.0, 360.0));
        let mut tools = Tools { tool: Tool::Look, ..Tools::default() };
        assert_eq!(tools.use_on(&mut stage, &near, &click, false, false), None, "there is more to see");
        assert!(tools.look_around(&mut near));
    }

    #[test]
    fn who_follows_nobody_follows_whom_the_tool_to_steer_is_used_on() {
        let mut stage = stage();
        let size = stage.world().config().size;
        let camera = Camera::whole(size, Vec2::new(640.0, 360.0));
        let agar = stage.world_mut().spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
        let cursor = camera.to_screen(Vec2::splat(20.0));
        let click = Input { cursor, is_clicked: true, is_held: true, ..Input::default() };
        assert_eq!(Tools::default().use_on(&mut stage, &camera, &click, false, false), None);
        assert_eq!(stage.player(), Some(agar));
    }

    #[test]
    fn looking_around_holds_the_room_under_the_cursor() {
        let (mut stage, mut tools) = (stage(), Tools { tool: Tool::Look, ..Tools::default() });
        let size = stage.world().config().size;
        let mut camera = Camera::around(0.5 * size, 30.0, size, Vec2::new(640.0, 360.0));
        let grip = camera.to_room(Vec2::new(300.0, 200.0));
        for (x, y, is_clicked) in [(300.0, 200.0, true), (330.0, 190.0, false), (360.0, 190.0, false)] {
            let input = Input { cursor: Vec2::new(x, y), is_clicked, is_held: true, ..Input::default() };
            assert_eq!(tools.use_on(&mut stage, &camera, &input, false, false), None);
            assert!(tools.look_around(&mut camera));
            assert!((camera.to_room(input.cursor) - grip).length() < 1e-3, "{x}");
        }
        assert!(!Tools::default().look_around(&mut camera));
    }

    #[test]
    fn pushing_clears_a_place_and_occupied_places_are_refused() {
        let mut stage = stage();
        let mut tools = Tools { tool: Tool::Spawn, ..Tools::default() };
        tools.put_in(&mut stage, Vec2::new(62.0, 45.0)).unwrap();
        assert!(tools.put_in(&mut stage, Vec2::new(62.0, 45.0)).unwrap_err().starts_with("No room here"));
        let outside = tools.put_in(&mut stage, Vec2::new(-20.0, 45.0)).unwrap_err();
        assert!(outside.starts_with("Outside"), "{outside}");
        (tools.tool, tools.hand) = (Tool::Push, Some(Vec2::new(60.0, 45.0)));
        for _ in 0..60 {
            tools.step(&mut stage);
        }
        let id = stage.world().organisms().next().unwrap();
        assert!((stage.world().centroid(id).unwrap() - Vec2::new(60.0, 45.0)).length() > PUSH_RADIUS - 1.0);
    }
}
