//! Who is in which room, and who is told what. It knows no sockets and no clock.

use super::code::Code;
use super::frame;
use super::limits::MEMBERS;
use hyper::body::Bytes;
use std::collections::HashMap;
use std::time::Instant;

/// The way to a member.
pub(super) trait Outbox {
    /// Hands over a frame; false when too much waits for the member already.
    fn offer(&self, frame: Bytes) -> bool;
}

/// Why a member may not stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    NoRoomLeft,
    RoomIsFull,
    NoReceiver,
    WrongReceiver,
    /// He has been dropped already.
    TooSlow,
}

impl Refusal {
    pub(super) fn reason(self) -> &'static str {
        match self {
            Self::NoRoomLeft => "the server has no room left",
            Self::RoomIsFull => "the room is full",
            Self::NoReceiver => "a message without a receiver",
            Self::WrongReceiver => "a message to a receiver who cannot be there",
            Self::TooSlow => "the connection is too slow",
        }
    }
}

/// The seat of a member, whose number is another's after him.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Place {
    code: Code,
    member: u8,
    ticket: u64,
}

#[derive(Debug)]
struct Seat<O> {
    ticket: u64,
    /// By which its member gets it back after a cut; may be empty.
    key: String,
    outbox: O,
}

/// The place of a member whose connection was cut, or who was too slow.
#[derive(Debug)]
struct Kept {
    member: u8,
    ticket: u64,
    key: String,
    /// None as long as the connection has not ended.
    until: Option<Instant>,
}

/// Seats by the numbers of members, and those that are kept.
#[derive(Debug)]
struct Room<O> {
    seats: [Option<Seat<O>>; MEMBERS],
    kept: Vec<Kept>,
}

impl<O: Outbox> Room<O> {
    fn members(&self) -> impl Iterator<Item = u8> {
        (0..).zip(&self.seats).filter(|(_, seat)| seat.is_some()).map(|(member, _)| member)
    }

    fn has(&self, place: &Place) -> bool {
        self.seats[usize::from(place.member)].as_ref().is_some_and(|seat| seat.ticket == place.ticket)
    }

    /// Sends to one member; whoever is too slow leaves.
    fn send(&mut self, to: u8, frame: Bytes) {
        if self.seats[usize::from(to)].as_ref().is_some_and(|seat| !seat.outbox.offer(frame)) {
            self.remove(to);
        }
    }

    fn send_to_others(&mut self, member: u8, frame: &Bytes) {
        (0..MEMBERS as u8).filter(|to| *to != member).for_each(|to| self.send(to, frame.clone()));
    }

    /// The number of who has this key, if it is here or was a moment ago.
    fn number_of(&self, key: &str) -> Option<u8> {
        let has_key = |(_, seat): &(u8, &Option<Seat<O>>)| seat.as_ref().is_some_and(|seat| seat.key == key);
        let here = (0..).zip(&self.seats).find(has_key).map(|(member, _)| member);
        let kept = || self.kept.iter().find(|kept| kept.key == key).map(|kept| kept.member);
        here.or_else(kept).filter(|_| !key.is_empty())
    }

    /// The lowest number that nobody has or may come back to.
    fn free(&self) -> Option<u8> {
        let is_kept = |member: u8| self.kept.iter().any(|kept| kept.member == member);
        let mut free = (0..).zip(&self.seats).filter(|(member, seat)| seat.is_none() && !is_kept(*member));
        free.next().map(|(member, _)| member)
    }

    fn remove(&mut self, member: u8) {
        let seat = self.seats[usize::from(member)].take().filter(|seat| !seat.key.is_empty());
        self.kept.extend(seat.map(|Seat { ticket, key, .. }| Kept { member, ticket, key, until: None }));
        self.send_to_others(member, &frame::left(member));
    }
}

/// All rooms. One is made by who first comes with its code, and goes with the last member.
#[derive(Debug)]
pub(super) struct Rooms<O> {
    rooms: HashMap<Code, Room<O>>,
    most: usize,
    /// What each member is told after the welcome.
    helpers: Option<Bytes>,
    tickets: u64,
}

impl<O: Outbox> Rooms<O> {
    pub(super) fn new(most: usize, helpers: Option<Bytes>) -> Self {
        Self { rooms: HashMap::new(), most, helpers, tickets: 0 }
    }

    /// Takes the seat that this key had, or the lowest free one. The first frame for the new member is his welcome.
    pub(super) fn join(&mut self, code: Code, key: String, now: Instant, outbox: O) -> Result<Place, Refusal> {
        if self.rooms.len() >= self.most && !self.rooms.contains_key(&code) {
            return Err(Refusal::NoRoomLeft);
        }
        let room = self
            .rooms
            .entry(code.clone())
            .or_insert_with(|| Room { seats: [const { None }; MEMBERS], kept: Vec::new() });
        room.kept.retain(|kept| kept.until.is_none_or(|until| until > now));
        let former = room.number_of(&key);
        let member = former.or_else(|| room.free()).ok_or(Refusal::RoomIsFull)?;
        room.kept.retain(|kept| kept.member != member);
        self.tickets += 1;
        let place = Place { code, member, ticket: self.tickets };
        outbox.offer(frame::welcome(member, room.members().filter(|other| *other != member)));
        // Nothing waits for a new member: there is room for both.
        if let Some(helpers) = &self.helpers {
            outbox.offer(helpers.clone());
        }
        room.seats[usize::from(member)] = Some(Seat { ticket: place.ticket, key, outbox });
        let news = if former.is_some() { frame::back(member) } else { frame::joined(member) };
        room.send_to_others(member, &news);
        Ok(place)
    }

    /// Gives a seat back, or keeps it for its member's key until then; nothing if another connection has it.
    pub(super) fn leave(&mut self, place: &Place, until: Option<Instant>) {
        let Some(room) = self.rooms.get_mut(&place.code) else { return };
        if room.has(place) {
            room.remove(place.member);
        }
        // Whoever was too slow has lost its seat before.
        room.kept.iter_mut().filter(|kept| kept.ticket == place.ticket).for_each(|kept| kept.until = until);
        room.kept.retain(|kept| kept.ticket != place.ticket || until.is_some());
        if room.members().next().is_none() {
            self.rooms.remove(&place.code);
        }
    }

    /// Passes a frame of a member on to its receiver. One to a seat that is free is lost.
    pub(super) fn relay(&mut self, place: &Place, frame: &[u8]) -> Result<(), Refusal> {
        let (to, message) = frame.split_first().ok_or(Refusal::NoReceiver)?;
        let room = self.rooms.get_mut(&place.code).filter(|room| room.has(place)).ok_or(Refusal::TooSlow)?;
        if usize::from(*to) >= MEMBERS || *to == place.member {
            return Err(Refusal::WrongReceiver);
        }
        room.send(*to, [&[place.member], message].concat().into());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;
    use std::collections::BTreeSet;
    use std::rc::Rc;
    use std::time::Duration;

    /// Frames for a member, with room for so many.
    #[derive(Clone, Debug)]
    struct Shelf(Rc<RefCell<Vec<Bytes>>>, usize);

    impl Shelf {
        fn new(room: usize) -> Self {
            Self(Rc::default(), room)
        }

        fn take(&self) -> Vec<Vec<u8>> {
            self.0.take().iter().map(|frame| frame.to_vec()).collect()
        }
    }

    impl Outbox for Shelf {
        fn offer(&self, frame: Bytes) -> bool {
            let has_room = self.0.borrow().len() < self.1;
            self.0.borrow_mut().extend(has_room.then_some(frame));
            has_room
        }
    }

    fn code(text: &str) -> Code {
        Code::read(text).unwrap()
    }

    /// Somebody without a key.
    fn join(rooms: &mut Rooms<Shelf>, code: Code, shelf: Shelf) -> Result<Place, Refusal> {
        rooms.join(code, String::new(), Instant::now(), shelf)
    }

    /// A room with so many members, who have read everything.
    fn room_of(count: usize) -> (Rooms<Shelf>, Vec<(Place, Shelf)>) {
        let mut rooms = Rooms::new(10, None);
        let mut enter = || {
            let shelf = Shelf::new(100);
            (join(&mut rooms, code("ROOM"), shelf.clone()).unwrap(), shelf)
        };
        let members: Vec<_> = (0..count).map(|_| enter()).collect();
        members.iter().for_each(|(_, shelf)| drop(shelf.take()));
        (rooms, members)
    }

    #[test]
    fn the_lowest_free_number_is_given_and_all_are_told() {
        let (mut rooms, members) = room_of(4);
        assert_eq!(members.iter().map(|(place, _)| place.member).collect::<Vec<_>>(), [0, 1, 2, 3]);
        assert_eq!(join(&mut rooms, code("room"), Shelf::new(9)), Err(Refusal::RoomIsFull));
        rooms.leave(&members[1].0, None);
        assert_eq!(members[0].1.take(), [[0xff, 2, 1]]);
        let again = Shelf::new(9);
        assert_eq!(join(&mut rooms, code("ROOM"), again.clone()).unwrap().member, 1);
        assert_eq!(again.take(), [[0xff, 0, 1, 0, 2, 3]]);
        assert_eq!(members[3].1.take(), [[0xff, 2, 1], [0xff, 1, 1]]);
        rooms.leave(&members[1].0, None);
        assert!(members[0].1.take().iter().all(|frame| *frame != [0xff, 2, 1]), "the number is another's now");
    }

    #[test]
    fn who_was_cut_gets_its_number_back_by_its_key_and_nobody_else_meanwhile() {
        let (mut rooms, members) = room_of(2);
        let now = Instant::now();
        let enter = |rooms: &mut Rooms<Shelf>, key: &str, after| {
            let place = rooms.join(code("ROOM"), key.to_owned(), now + Duration::from_secs(after), Shelf::new(9));
            place.map(|place| (place.member, place))
        };
        let (number, place) = enter(&mut rooms, "secret", 0).unwrap();
        assert_eq!((number, members[0].1.take()), (2, vec![vec![0xff, 1, 2]]));
        rooms.leave(&place, Some(now + Duration::from_secs(30)));
        let (other, stranger) = enter(&mut rooms, "guess", 1).unwrap();
        assert_eq!((other, members[0].1.take()), (3, vec![vec![0xff, 2, 2], vec![0xff, 1, 3]]));
        assert_eq!(enter(&mut rooms, "", 2), Err(Refusal::RoomIsFull), "the place is kept");
        let (number, place) = enter(&mut rooms, "secret", 29).unwrap();
        assert_eq!((number, members[0].1.take()), (2, vec![vec![0xff, 5, 2]]));
        let (number, again) = enter(&mut rooms, "secret", 29).unwrap();
        assert_eq!((number, members[0].1.take()), (2, vec![vec![0xff, 5, 2]]), "before the cut was seen");
        rooms.leave(&place, None);
        assert!(rooms.relay(&place, &[0, 1]).is_err() && rooms.relay(&again, &[0, 1]).is_ok());
        rooms.leave(&stranger, None);
        rooms.leave(&again, Some(now + Duration::from_secs(59)));
        assert_eq!(enter(&mut rooms, "", 59).unwrap().0, 2, "after that it is anybody's");
    }

    #[test]
    fn a_message_goes_to_its_receiver_alone() {
        let (mut rooms, members) = room_of(3);
        let other = Shelf::new(9);
        join(&mut rooms, code("OTHER"), other.clone()).unwrap();
        other.take();
        rooms.relay(&members[2].0, &[1, 7, 8]).unwrap();
        assert_eq!(members[1].1.take(), [[2, 7, 8]]);
        rooms.relay(&members[2].0, &[3, 7, 8]).unwrap();
        assert!([&members[0].1, &members[2].1, &other].iter().all(|shelf| shelf.take().is_empty()));
    }

    #[test]
    fn wrong_receivers_are_refused() {
        let (mut rooms, members) = room_of(2);
        assert_eq!(rooms.relay(&members[0].0, &[]), Err(Refusal::NoReceiver));
        for to in [0, 4, 0xff] {
            assert_eq!(rooms.relay(&members[0].0, &[to, 1]), Err(Refusal::WrongReceiver));
        }
        assert!(members[1].1.take().is_empty());
    }

    #[test]
    fn a_slow_member_is_dropped_and_the_others_are_told() {
        let (mut rooms, members) = room_of(2);
        let slow = Shelf::new(2);
        let place = join(&mut rooms, code("ROOM"), slow.clone()).unwrap();
        (0..2).for_each(|_| rooms.relay(&members[0].0, &[2, 1]).unwrap());
        assert_eq!(members[1].1.take(), [[0xff, 1, 2], [0xff, 2, 2]]);
        assert_eq!(rooms.relay(&place, &[0, 1]), Err(Refusal::TooSlow));
    }

    #[test]
    fn the_place_of_who_was_too_slow_is_kept() {
        let (mut rooms, members) = room_of(2);
        let now = Instant::now();
        let slow = rooms.join(code("ROOM"), "secret".to_owned(), now, Shelf::new(1)).unwrap();
        rooms.relay(&members[0].0, &[2, 1]).unwrap();
        assert_eq!(join(&mut rooms, code("ROOM"), Shelf::new(9)).unwrap().member, 3, "its connection has not ended");
        rooms.leave(&slow, Some(now + Duration::from_secs(30)));
        let again = rooms.join(code("ROOM"), "secret".to_owned(), now + Duration::from_secs(29), Shelf::new(9));
        assert_eq!(again.unwrap().member, 2);
    }

    #[test]
    fn rooms_are_counted_and_go_with_the_last_member() {
        let mut rooms = Rooms::new(2, None);
        let place = join(&mut rooms, code("ONE1"), Shelf::new(9)).unwrap();
        join(&mut rooms, code("TWO2"), Shelf::new(9)).unwrap();
        assert_eq!(join(&mut rooms, code("THREE"), Shelf::new(9)), Err(Refusal::NoRoomLeft));
        join(&mut rooms, code("TWO2"), Shelf::new(9)).unwrap();
        rooms.leave(&place, None);
        rooms.leave(&place, None);
        assert!(join(&mut rooms, code("THREE"), Shelf::new(9)).is_ok());
    }

    fn is_there(rooms: &Rooms<Shelf>, place: &Place) -> bool {
        rooms.rooms.get(&place.code).is_some_and(|room| room.has(place))
    }

    /// Who is there besides oneself, as told by frames.
    fn told(others: &mut BTreeSet<u8>, frames: &[Vec<u8>]) {
        for frame in frames {
            match frame[..] {
                [0xff, 0, _, ref there @ ..] => others.extend(there),
                [0xff, 1, member] => assert!(others.insert(member)),
                [0xff, 2, member] => assert!(others.remove(&member)),
                [from, ..] => assert!(others.contains(&from), "{from} is not there"),
                [] => panic!("an empty frame"),
            }
        }
    }

    /// A member, what it has not read, and who it believes is there.
    type Visitor = (Place, Shelf, BTreeSet<u8>);

    /// One of the members reads everything, and leaves if the room has given it up.
    fn read(rooms: &mut Rooms<Shelf>, members: &mut Vec<Visitor>, which: usize) {
        let (place, shelf, others) = &mut members[which];
        told(others, &shelf.take());
        if !is_there(rooms, place) {
            rooms.leave(&members.swap_remove(which).0, None);
        }
    }

    fn assert_all_know_each_other(mut members: Vec<Visitor>) {
        for (place, shelf, others) in &mut members {
            told(others, &shelf.take());
            others.insert(place.member);
        }
        let all: BTreeSet<u8> = members.iter().map(|(place, ..)| place.member).collect();
        assert!(members.iter().all(|(_, _, others)| *others == all), "{members:?}");
    }

    #[test]
    fn whatever_happens_members_know_who_is_there() {
        let mut state = 7u64;
        let mut below = |count: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % count
        };
        let mut rooms = Rooms::new(1, None);
        let mut members: Vec<Visitor> = Vec::new();
        for _ in 0..20_000 {
            match below(8) {
                0 => {
                    let shelf = Shelf::new(6);
                    let joined = join(&mut rooms, code("ROOM"), shelf.clone());
                    members.extend(joined.map(|place| (place, shelf, BTreeSet::new())));
                }
                1 if !members.is_empty() => rooms.leave(&members.swap_remove(below(members.len())).0, None),
                k if !members.is_empty() => {
                    let frame: Vec<u8> = (0..below(4)).map(|_| below(6) as u8).collect();
                    let sender = below(members.len());
                    if k > 5
                        || rooms.relay(&members[sender].0, &frame).is_err_and(|refusal| refusal == Refusal::TooSlow)
                    {
                        read(&mut rooms, &mut members, sender);
                    }
                }
                _ => {}
            }
        }
        members.retain(|(place, ..)| is_there(&rooms, place));
        assert_all_know_each_other(members);
    }
}
