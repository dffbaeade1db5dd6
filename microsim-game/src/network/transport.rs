//! What carries messages between the players of a room.

/// Number of a member of a room, 0 to 3, given by the room in the order of joining.
pub type Member = u8;

/// Longest message, bytes.
pub const LONGEST_MESSAGE: usize = 64 * 1024;

/// What happened in a room since it was asked last.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Notice {
    /// The room is entered, as this member; those who are there already.
    Welcome {
        /// The own number.
        member: Member,
        /// The numbers of the others.
        others: Vec<Member>,
    },
    /// Another member has come.
    Joined(Member),
    /// A member whose connection was cut has come back; nobody else can have its number meanwhile.
    Back(Member),
    /// Another member has gone.
    Left(Member),
    /// A message of another member.
    Message {
        /// Who has sent it.
        from: Member,
        /// What he has sent.
        bytes: Vec<u8>,
    },
    /// The way is cut, with a reason for people. Nothing follows.
    Closed(String),
}

/// A way to the other members of a room. Messages are lost, late, doubled or out of order at will.
pub trait Transport: std::fmt::Debug {
    /// What happened since the last call, in order.
    fn poll(&mut self) -> Vec<Notice>;
    /// Sends a message to one member, without waiting; its first byte is not 255.
    fn send(&mut self, to: Member, bytes: &[u8]);
}
