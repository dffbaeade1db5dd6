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

fn rooms(names: &[&str]) -> (Vec<Room>, Boxes) {
    let boxes: Boxes = Rc::new(RefCell::new(vec![Vec::new(); names.len()]));
    let members: Vec<Member> = (0..names.len() as Member).collect();
    let rooms = (0..).zip(names).map(|(own, name)| {
        let others = members.iter().copied().filter(|&other| other != own).collect();
        boxes.borrow_mut()[usize::from(own)].push(Notice::Welcome { member: own, others });
        Room::new(Box::new(Wire { own, boxes: boxes.clone() }), "ABCD", name)
    });
    (rooms.collect(), boxes)
}

fn run(rooms: &mut [Room], ticks: std::ops::Range<u32>) {
    for tick in ticks {
        for room in &mut *rooms {
            room.update(33 * tick, 7);
            room.advance(Intent::REST, 33 * tick);
        }
    }
}

#[test]
fn all_who_are_ready_begin_the_same_match_and_one_who_leaves_is_replaced() {
    let (mut rooms, boxes) = rooms(&["Ann", "B\u{1b}[2J\u{202e}en", ""]);
    run(&mut rooms, 0..3);
    let names: Vec<String> = rooms[0].seats().into_iter().map(|seat| seat.name).collect();
    assert_eq!(names, ["Ann", "B[2Jen", "Player 3"]);
    assert!(rooms[0].leads() && !rooms[1].leads() && rooms[0].seats()[0].is_own);
    rooms[0].set_way(TwoPlayers::Together);
    rooms[0].set_ready(true);
    rooms[1].set_ready(true);
    run(&mut rooms, 3..6);
    assert!(rooms[0].session().is_none() && rooms[1].way() == TwoPlayers::Together, "one is not ready");
    rooms[2].set_ready(true);
    run(&mut rooms, 6..50);
    let frames = |room: &Room| room.session().map(|(session, _)| session.frame());
    assert!(rooms.iter().all(|room| frames(room) > Some(30)), "{:?}", rooms.iter().map(frames).collect::<Vec<_>>());
    drop(rooms.pop());
    boxes.borrow_mut()[..2].iter_mut().for_each(|notices| notices.push(Notice::Left(2)));
    run(&mut rooms, 50..100);
    assert!(rooms.iter().all(|room| frames(room) > Some(80) && room.session().unwrap().0.desync().is_none()));
    let [a, b] = [0, 1].map(|k| rooms[k].finish().unwrap().0.digests().to_vec());
    assert!(a.len() >= 2 && a[..2] == b[..2]);
}

#[test]
fn programs_that_differ_do_not_play() {
    let (mut rooms, _) = rooms(&["a", "b"]);
    rooms[1].hello.program.digest ^= 1;
    rooms.iter_mut().for_each(|room| room.set_ready(true));
    run(&mut rooms, 0..5);
    assert!(rooms.iter().all(|room| room.session().is_none()));
    assert_eq!(rooms[0].seats()[1].note, "has another version");
}

#[test]
fn what_a_stranger_sends_changes_nothing() {
    let (mut rooms, boxes) = rooms(&["a", "b"]);
    rooms[0].set_ready(true);
    run(&mut rooms, 0..3);
    let start = |seats: &[Member], number| Start { number, seed: 1, together: false, seats: seats.to_vec() };
    let calls = [start(&[0, 1], 1), start(&[1, 0], 1), start(&[0, 3], 1), start(&[], 1), start(&[0, 1], 0)];
    for (from, bytes) in
        calls.into_iter().map(|call| (1, write(&Message::Start(call)))).chain([(9, vec![0; 9]), (1, vec![255; 900])])
    {
        boxes.borrow_mut()[0].push(Notice::Message { from, bytes });
    }
    boxes.borrow_mut()[0].extend([Notice::Joined(77), Notice::Joined(1), Notice::Left(5)]);
    run(&mut rooms, 3..5);
    assert!(rooms[0].session().is_none() && rooms[0].seats().len() == 2);
}
