//! Rooms whose members are all in this process.

use super::*;
use crate::network::plan::{FrameRate, Way};
use microsim_core::Intent;
use std::cell::RefCell;
use std::rc::Rc;

type Boxes = Rc<RefCell<Vec<Vec<Notice>>>>;

/// A way that loses nothing.
#[derive(Debug)]
struct Wire {
    own: Member,
    boxes: Boxes,
}

impl Transport for Wire {
    fn poll(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.boxes.borrow_mut()[usize::from(self.own)])
    }

    fn send(&mut self, to: Member, bytes: &[u8]) {
        let notice = Notice::Message { from: self.own, bytes: bytes.to_vec() };
        self.boxes.borrow_mut()[usize::from(to)].push(notice);
    }
}

/// A member, and the match that it is in.
struct Player {
    room: Room,
    current: Option<Match>,
}

impl Player {
    fn frame(&self) -> u32 {
        self.current.as_ref().map_or(0, |current| current.session().frame())
    }
}

fn players(names: &[&str]) -> (Vec<Player>, Boxes) {
    let boxes: Boxes = Rc::new(RefCell::new(vec![Vec::new(); 4]));
    let members: Vec<Member> = (0..names.len() as Member).collect();
    let players = (0..).zip(names).map(|(own, name)| {
        let others = members.iter().copied().filter(|&other| other != own).collect();
        boxes.borrow_mut()[usize::from(own)].push(Notice::Welcome { member: own, others });
        Player { room: Room::new(Box::new(Wire { own, boxes: boxes.clone() }), "ABCD", name), current: None }
    });
    (players.collect(), boxes)
}

fn run(players: &mut [Player], ticks: std::ops::Range<u32>) {
    for tick in ticks {
        for Player { room, current } in &mut *players {
            let begun = room.update(33 * tick, 7, current.as_mut());
            *current = current.take().or(begun);
            if let Some(current) = current {
                (0..20).take_while(|_| current.catch_up()).for_each(drop);
                room.advance(current, Intent::REST, 33 * tick);
            }
        }
    }
}

#[test]
fn all_who_are_ready_begin_the_same_match_and_one_who_leaves_is_replaced() {
    let (mut players, boxes) = players(&["Ann", "B\u{1b}[2J\u{202e}en", ""]);
    run(&mut players, 0..3);
    let names: Vec<String> = players[0].room.seats().into_iter().map(|seat| seat.name).collect();
    assert_eq!(names, ["Ann", "B[2Jen", "Player 3"]);
    assert!(players[0].room.leads() && !players[1].room.leads() && players[0].room.seats()[0].is_own);
    players[0].room.set_plan(Plan { way: Way::Together, ..Plan::default() });
    players[..2].iter_mut().for_each(|player| player.room.set_ready(true));
    run(&mut players, 3..6);
    assert!(players[0].current.is_none() && players[1].room.plan().way == Way::Together, "one is not ready");
    players[2].room.set_ready(true);
    run(&mut players, 6..50);
    let frames: Vec<u32> = players.iter().map(Player::frame).collect();
    assert!(frames.iter().all(|&frame| frame > 30), "{frames:?}");
    drop(players.pop());
    boxes.borrow_mut()[..2].iter_mut().for_each(|notices| notices.push(Notice::Left(2)));
    run(&mut players, 50..100);
    let matches: Vec<&Match> = players.iter().filter_map(|player| player.current.as_ref()).collect();
    assert!(matches.iter().all(|current| current.session().frame() > 80 && current.session().desync().is_none()));
    let digests: Vec<_> = matches.iter().map(|current| &current.session().digests()[..2]).collect();
    assert_eq!(digests[0], digests[1]);
    assert!(matches.iter().all(|current| current.plan().way == Way::Together));
}

#[test]
fn the_first_member_chooses_the_frames_a_second_and_the_seed_for_all_and_for_who_comes_late() {
    let (mut players, boxes) = players(&["Ada", "Ben"]);
    let quick = Plan { rate: FrameRate::Quick, ..Plan::default() };
    players[0].room.set_plan(quick);
    players[0].room.set_seed(Some(u64::MAX));
    players[1].room.set_seed(Some(5));
    run(&mut players, 0..3);
    assert_eq!((players[1].room.plan(), players[1].room.seed()), (quick, Some(u64::MAX)), "all see it");
    players.iter_mut().for_each(|player| player.room.set_ready(true));
    run(&mut players, 3..100);
    let late = enter(&mut players, &boxes, 2, Notice::Joined(2));
    players.push(late);
    run(&mut players, 100..250);
    assert_eq!(cells(&players), [Some(0), Some(1), None]);
    for player in &players {
        let session = player.current.as_ref().unwrap().session();
        assert_eq!((session.steps(), session.round().world().config().seed), (1, u64::MAX));
        assert_eq!(session.round().world().step_index(), u64::from(session.frame()));
    }
}

#[test]
fn a_slide_is_played_in_a_room_and_a_bot_goes_to_the_place_of_who_left() {
    let (mut players, boxes) = players(&["Ada", "Ben"]);
    run(&mut players, 0..3);
    let choose = |players: &mut [Player], slide| {
        players[0].room.set_plan(Plan { way: Way::Slide(slide), ..Plan::default() });
        players.iter_mut().for_each(|player| player.room.set_ready(true));
    };
    choose(&mut players, u8::MAX);
    run(&mut players, 3..50);
    assert!(players.iter().all(|player| player.current.is_none()), "no such slide");
    choose(&mut players, 0);
    run(&mut players, 50..60);
    drop(players.pop());
    boxes.borrow_mut()[0].push(Notice::Left(1));
    run(&mut players, 60..400);
    let session = players[0].current.as_ref().unwrap().session();
    let places: Vec<u32> = session.round().attempt().unwrap().goals().map(|(_, done)| done).collect();
    assert_eq!(places, [1, 0, 0]);
}

/// Two who play, and a member who comes to their room; the match that it is in is a new one.
fn enter(players: &mut [Player], boxes: &Boxes, own: Member, news: Notice) -> Player {
    let others = vec![0, 1, 2].into_iter().filter(|&other| other != own && other < players.len() as Member).collect();
    let mut all = boxes.borrow_mut();
    all[usize::from(own)] = vec![Notice::Welcome { member: own, others }];
    let there = (0..players.len()).filter(|&other| other != usize::from(own));
    there.for_each(|other| all[other].push(news.clone()));
    let mut room = Room::new(Box::new(Wire { own, boxes: boxes.clone() }), "ABCD", "Cid");
    room.set_ready(true);
    Player { room, current: None }
}

fn two_who_play() -> (Vec<Player>, Boxes) {
    let (mut players, boxes) = players(&["Ada", "Ben"]);
    players.iter_mut().for_each(|player| player.room.set_ready(true));
    run(&mut players, 0..50);
    (players, boxes)
}

/// The numbers of cells, when all are in the same world.
fn cells(players: &[Player]) -> Vec<Option<usize>> {
    let matches: Vec<&Match> = players.iter().filter_map(|player| player.current.as_ref()).collect();
    let digests: Vec<_> = matches.iter().map(|game| game.session().digests().to_vec()).collect();
    let least = digests.iter().map(Vec::len).min().unwrap_or(0);
    assert!(least > 0 && digests.iter().all(|own| own[..least] == digests[0][..least]), "{digests:?}");
    assert!(matches.iter().all(|game| game.session().desync().is_none() && game.session().tally().refused == 0));
    matches.iter().map(|game| game.own()).collect()
}

#[test]
fn who_was_cut_gets_its_cell_back_and_a_stranger_only_after_thirty_seconds() {
    for (news, after) in [(Notice::Back(1), 150), (Notice::Joined(1), 930)] {
        let (mut players, boxes) = two_who_play();
        boxes.borrow_mut()[0].push(Notice::Left(1));
        players.pop();
        run(&mut players, 50..90);
        let player = enter(&mut players, &boxes, 1, news);
        players.push(player);
        run(&mut players, 90..after);
        if after > 200 {
            assert_eq!(cells(&players), [Some(0), None], "it may come back yet");
            run(&mut players, after..after + 80);
        }
        assert_eq!(cells(&players), [Some(0), Some(1)]);
    }
}

#[test]
fn who_is_cut_for_a_moment_goes_on_in_the_same_room() {
    let (mut players, boxes) = two_who_play();
    players[1].room.reopen(Box::new(Wire { own: 1, boxes: boxes.clone() }));
    players[1].current = None;
    boxes.borrow_mut()[1] = vec![Notice::Welcome { member: 1, others: vec![0] }];
    boxes.borrow_mut()[0].push(Notice::Back(1));
    run(&mut players, 50..150);
    assert_eq!(cells(&players), [Some(0), Some(1)]);
}

#[test]
fn who_comes_late_watches_and_nobody_waits_for_it() {
    let (mut players, boxes) = two_who_play();
    let player = enter(&mut players, &boxes, 2, Notice::Joined(2));
    players.push(player);
    run(&mut players, 50..150);
    assert_eq!(cells(&players), [Some(0), Some(1), None]);
    let frames: Vec<u32> = players.iter().map(Player::frame).collect();
    assert!(frames[0] > 140 && frames[2] + 8 > frames[0], "{frames:?}");
    assert_eq!(players[2].current.as_ref().unwrap().names(), ["Ada", "Ben"]);
    // It falls silent, and they go on; they leave one after the other, and it sees the rest.
    let late = players.pop().unwrap();
    run(&mut players, 150..200);
    assert!(players.iter().all(|player| player.frame() > 190));
    players.push(late);
    boxes.borrow_mut()[1].push(Notice::Left(0));
    boxes.borrow_mut()[2].push(Notice::Left(0));
    players.remove(0);
    run(&mut players, 200..300);
    let frames: Vec<u32> = players.iter().map(Player::frame).collect();
    assert!(frames[1] + 8 > frames[0] && frames[0] > 280, "{frames:?}");
}

#[test]
fn odd_invitations_are_none() {
    let (mut players, boxes) = players(&["a", "b"]);
    run(&mut players, 0..3);
    let invite = |seats: Vec<Member>| {
        let start = Start { number: 1, plan: Plan::default(), seed: 1, seats };
        Notice::Message { from: 1, bytes: write(&Message::Invite(start)) }
    };
    boxes.borrow_mut()[0].push(invite(vec![0, 1]));
    run(&mut players, 3..5);
    assert!(players[0].current.is_none(), "not ready");
    players[0].room.set_ready(true);
    let odd = [vec![], vec![1], vec![0, 4], vec![0, 2], vec![0, 1, 2, 3, 0]];
    boxes.borrow_mut()[0].extend(odd.map(invite));
    run(&mut players, 5..7);
    assert!(players[0].current.is_none());
    players[1].room.hello.program.digest ^= 1;
    players[1].room.set_ready(false);
    run(&mut players, 7..9);
    boxes.borrow_mut()[0].push(invite(vec![0, 1]));
    run(&mut players, 9..11);
    assert!(players[0].current.is_none(), "another program");
}

#[test]
fn programs_that_differ_do_not_play() {
    let (mut players, _) = players(&["a", "b"]);
    players[1].room.hello.program.digest ^= 1;
    players.iter_mut().for_each(|player| player.room.set_ready(true));
    run(&mut players, 0..5);
    assert!(players.iter().all(|player| player.current.is_none()));
    assert_eq!(players[0].room.seats()[1].note, Key::RoomOtherVersion);
}

#[test]
fn what_a_stranger_sends_changes_nothing() {
    let (mut players, boxes) = players(&["a", "b"]);
    players[0].room.set_ready(true);
    run(&mut players, 0..3);
    let plan = Plan::default();
    let start = |seats: &[Member], number| Start { number, plan, seed: 1, seats: seats.to_vec() };
    let calls = [start(&[0, 1], 1), start(&[1, 0], 1), start(&[0, 3], 1), start(&[], 1), start(&[0, 1], 0)];
    let calls = calls.into_iter().map(|call| (1, write(&Message::Start(call))));
    for (from, bytes) in calls.chain([(9, vec![0; 9]), (1, vec![255; 900])]) {
        boxes.borrow_mut()[0].push(Notice::Message { from, bytes });
    }
    boxes.borrow_mut()[0].extend([Notice::Joined(77), Notice::Joined(1), Notice::Left(5)]);
    run(&mut players, 3..5);
    assert!(players[0].current.is_none() && players[0].room.seats().len() == 2);
}

#[test]
fn a_newcomer_who_is_the_first_begins_the_next_match() {
    let (mut players, boxes) = players(&["Ada", "Ben"]);
    players.iter_mut().for_each(|player| player.room.set_ready(true));
    run(&mut players, 0..10);
    assert!(players.iter().all(|player| player.frame() > 0));
    // Ada goes, and another one gets her number.
    boxes.borrow_mut()[0] = vec![Notice::Welcome { member: 0, others: vec![1] }];
    boxes.borrow_mut()[1].extend([Notice::Left(0), Notice::Joined(0)]);
    let wire = Wire { own: 0, boxes };
    players[0] = Player { room: Room::new(Box::new(wire), "ABCD", "Cid"), current: None };
    players[0].room.set_ready(true);
    run(&mut players, 10..80);
    assert_eq!(players[0].current.as_ref().unwrap().own(), None, "Ben plays, and Cid watches");
    for player in &mut players {
        player.current = None;
        player.room.finish();
        player.room.set_ready(true);
    }
    run(&mut players, 80..150);
    assert!(players.iter().all(|player| player.frame() > 0 && player.current.as_ref().unwrap().own().is_some()));
}

#[test]
fn who_comes_late_finds_the_leader_behind_a_newcomer_who_is_the_first() {
    let (mut players, boxes) = two_who_play();
    // Ada goes, another one gets her number and is not ready, and a third one comes.
    boxes.borrow_mut()[1].push(Notice::Left(0));
    let mut cid = enter(&mut players, &boxes, 0, Notice::Joined(0));
    cid.room.set_ready(false);
    players[0] = cid;
    let dan = enter(&mut players, &boxes, 2, Notice::Joined(2));
    players.push(dan);
    run(&mut players, 50..150);
    assert!(players[0].current.is_none());
    assert_eq!(cells(&players), [Some(1), None]);
}
