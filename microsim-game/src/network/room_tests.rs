//! Rooms whose members are all in this process.

use super::*;
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
    let boxes: Boxes = Rc::new(RefCell::new(vec![Vec::new(); names.len()]));
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
                current.advance(room, Intent::REST, 33 * tick);
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
    players[0].room.set_way(TwoPlayers::Together);
    players[..2].iter_mut().for_each(|player| player.room.set_ready(true));
    run(&mut players, 3..6);
    assert!(players[0].current.is_none() && players[1].room.way() == TwoPlayers::Together, "one is not ready");
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
    assert!(matches.iter().all(|current| current.way() == TwoPlayers::Together));
}

#[test]
fn programs_that_differ_do_not_play() {
    let (mut players, _) = players(&["a", "b"]);
    players[1].room.hello.program.digest ^= 1;
    players.iter_mut().for_each(|player| player.room.set_ready(true));
    run(&mut players, 0..5);
    assert!(players.iter().all(|player| player.current.is_none()));
    assert_eq!(players[0].room.seats()[1].note, "has another version");
}

#[test]
fn what_a_stranger_sends_changes_nothing() {
    let (mut players, boxes) = players(&["a", "b"]);
    players[0].room.set_ready(true);
    run(&mut players, 0..3);
    let start = |seats: &[Member], number| Start { number, seed: 1, together: false, seats: seats.to_vec() };
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
    assert!(players[0].current.is_none(), "Ben plays, and is not ready");
    players[1].current = None;
    players[1].room.finish();
    players[1].room.set_ready(true);
    run(&mut players, 80..150);
    assert!(players.iter().all(|player| player.frame() > 0));
}
