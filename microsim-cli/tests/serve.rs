//! `microsim serve` as it runs, with guests who behave and guests who do not.

#![cfg(unix)]

mod common;
#[path = "common/serve.rs"]
mod serve;

use common::{microsim, refused};
use serve::{Guest, Server, TIMEOUT};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::Stdio;
use std::time::{Duration, Instant};
use tungstenite::Message;

const LONGEST: usize = 64 * 1024;
#[test]
fn guests_of_a_room_meet() {
    let server = Server::start(&[]);
    let (mut one, mut two) = server.pair("K7M2QX");
    two.send(0, b"eat");
    one.expect(b"\x01eat");
    one.send(1, &vec![7; LONGEST]);
    assert_eq!(two.next().unwrap().len(), LONGEST + 1);
    server.enter("OTHER").expect(&[0xff, 0, 0]);
    drop(two);
    one.expect(&[0xff, 2, 1]);
    server.enter("k7m2qx").expect(&[0xff, 0, 1, 0]);
    one.expect(&[0xff, 1, 1]);
}

#[test]
fn members_are_told_who_helps_them_to_find_each_other() {
    let server = Server::start(&["--stun", "stun.example", "--turn", "lab:secret@turn.example:3478"]);
    let told =
        br#"[{"urls":"stun:stun.example"},{"urls":"turn:turn.example:3478","username":"lab","credential":"secret"}]"#;
    for number in 0..2 {
        let mut guest = server.enter("ROOM");
        assert_eq!(guest.next().unwrap()[..2], [0xff, 0], "guest {number} is welcome first");
        guest.expect(&[&[0xff, 4], &told[..]].concat());
    }
    refused(&["serve", "--turn", "turn.example"], "NAME:PASSWORD@");
    refused(&["serve", "--stun", "stun:stun.example:1"], "HOST");
}

#[test]
fn who_was_cut_has_its_number_again_and_who_goes_has_not() {
    let server = Server::start(&[]);
    let mut one = server.enter("ROOM");
    one.expect(&[0xff, 0, 0]);
    let mut two = server.enter_with_key("ROOM", "a1b2c3");
    two.expect(&[0xff, 0, 1, 0]);
    one.expect(&[0xff, 1, 1]);
    drop(two);
    one.expect(&[0xff, 2, 1]);
    server.enter_with_key("ROOM", "a1b2c4").expect(&[0xff, 0, 2, 0]);
    one.expect(&[0xff, 1, 2]);
    one.expect(&[0xff, 2, 2]);
    let mut two = server.enter_with_key("ROOM", "a1b2c3");
    two.expect(&[0xff, 0, 1, 0]);
    one.expect(&[0xff, 5, 1]);
    // Before the server knows that it is cut.
    let mut again = server.enter_with_key("ROOM", "a1b2c3");
    again.expect(&[0xff, 0, 1, 0]);
    one.expect(&[0xff, 5, 1]);
    again.send(0, b"here");
    one.expect(b"\x01here");
    assert_eq!(two.reason(), "the connection is too slow");
    again.0.close(None).unwrap();
    let _ = again.0.flush();
    one.expect(&[0xff, 2, 1]);
    server.enter("ROOM").expect(&[0xff, 0, 1, 0]);
}

#[test]
fn a_fifth_guest_and_a_room_too_many_are_refused() {
    let server = Server::start(&["--rooms", "1"]);
    let mut four: Vec<Guest> = (0..4).map(|_| server.enter("FULL")).collect();
    four.iter_mut().for_each(|guest| drop(guest.next()));
    assert_eq!(server.enter("FULL").reason(), "the room is full");
    assert_eq!(server.enter("MORE").reason(), "the server has no room left");
}

#[test]
fn odd_codes_and_pages_of_others_are_refused() {
    let server = Server::start(&[]);
    for code in ["", "abc", "abcdefghijklm", "ab%2fcd", "..%2f..", "a/bcd", "K7M2QX/", "%00%00%00%00", "%C3%A9%C3%A9"] {
        assert_eq!(server.try_enter(code, None).err(), Some(404), "{code:?}");
    }
    let own = format!("http://127.0.0.1:{}", server.port);
    assert!(server.try_enter("ROOM", Some(&own)).is_ok());
    for origin in ["http://elsewhere.example", "null", "http://127.0.0.1:1", &format!("{own}.example")] {
        assert_eq!(server.try_enter("ROOM", Some(origin)).err(), Some(403), "{origin}");
    }
}

/// Sends one message beside a guest who behaves, and returns why the sender is dropped.
fn reason_after(message: Message) -> String {
    let server = Server::start(&[]);
    let (mut good, mut bad) = server.pair("ROOM");
    let _ = bad.0.send(message);
    let reason = bad.reason();
    good.expect(&[0xff, 2, 1]);
    reason
}

#[test]
fn what_no_game_sends_ends_the_connection() {
    assert_eq!(reason_after(Message::text("\u{0}eat")), "text in place of bytes");
    assert_eq!(reason_after(Message::binary(vec![])), "a message without a receiver");
    for to in [1, 4, 0xff] {
        assert_eq!(reason_after(Message::binary(vec![to, 9])), "a message to a receiver who cannot be there");
    }
    assert_eq!(reason_after(Message::binary(vec![0; LONGEST + 2])), "a message that is too long");
    assert_eq!(reason_after(Message::binary(vec![0; 4 << 20])), "a message that is too long");
}

#[test]
fn bytes_that_are_no_frames_end_the_connection() {
    let server = Server::start(&[]);
    let mut state = 9u64;
    for _ in 0..200 {
        let mut guest = server.enter("ROOM");
        guest.next();
        let junk: Vec<u8> = (0..64)
            .map(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 56) as u8
            })
            .collect();
        let _ = guest.0.get_mut().write_all(&junk);
        let _ = guest.0.get_mut().shutdown(std::net::Shutdown::Write);
        while guest.next().is_some() {}
    }
    server.enter("ROOM").expect(&[0xff, 0, 0]);
}

#[test]
fn a_flood_is_read_later_and_harms_nobody() {
    const SENT: usize = 9000;
    let server = Server::start(&[]);
    let (mut to, mut flooder) = server.pair("ROOM");
    let (mut calm, mut other) = server.pair("CALM");
    let begin = Instant::now();
    let flood = std::thread::spawn(move || {
        (0..SENT).for_each(|_| flooder.send(0, &[0; 60]));
        flooder
    });
    for _ in 0..100 {
        let asked = Instant::now();
        other.send(0, b"?");
        calm.expect(b"\x01?");
        assert!(asked.elapsed() < Duration::from_secs(1));
    }
    (0..SENT).for_each(|_| to.expect(&[&[1][..], &[0; 60]].concat()));
    // 4000 at once and 1000 a second.
    assert!(begin.elapsed() > Duration::from_millis(4900), "{:?}", begin.elapsed());
    drop(flood.join());
}

#[test]
fn a_slow_reader_is_dropped() {
    let server = Server::start(&[]);
    let (mut sender, slow) = server.pair("ROOM");
    let begin = Instant::now();
    sender.0.get_ref().set_nonblocking(true).unwrap();
    let dropped = loop {
        // Loopback holds some megabytes by itself.
        let _ = sender.0.send(Message::binary([&[1][..], &[0; LONGEST]].concat()));
        match sender.0.read() {
            Ok(Message::Binary(frame)) => break frame,
            _ => std::thread::sleep(Duration::from_millis(1)),
        }
        assert!(begin.elapsed() < 2 * TIMEOUT, "nobody is dropped");
    };
    assert_eq!(&dropped[..], [0xff, 2, 1]);
    drop(slow);
}

#[test]
fn half_a_handshake_is_cut() {
    let server = Server::start(&[]);
    let begin = Instant::now();
    let silent = server.connect();
    let mut slow = server.connect();
    slow.write_all(b"GET /room/ROOM HTTP/1.1\r\nhost: here\r\nupgrade: websock").unwrap();
    for mut stream in [silent, slow] {
        let _ = stream.read_to_end(&mut Vec::new());
    }
    assert!(begin.elapsed() < Duration::from_secs(9), "{:?}", begin.elapsed());
    let answer = server.get("/room/ROOM");
    assert!(answer.starts_with("HTTP/1.1 400") && answer.ends_with("rooms are for WebSockets"), "{answer}");
    let long = format!("GET / HTTP/1.1\r\nx: {}\r\n\r\n", "y".repeat(100_000));
    assert!(!server.ask(long.as_bytes()).starts_with("HTTP/1.1 200"));
}

#[test]
fn the_server_says_that_it_stops() {
    let mut server = Server::start(&[]);
    let mut guest = server.enter("ROOM");
    guest.expect(&[0xff, 0, 0]);
    server.interrupt();
    assert_eq!(guest.reason(), "the server stops");
    assert_eq!(server.process.wait().unwrap().code(), Some(130));
}

#[test]
fn the_address_has_a_code_and_a_picture() {
    let server = Server::start(&[]);
    let code = server.line.trim_end().rsplit_once("/?room=").unwrap().1;
    assert_eq!(server.line, format!("http://127.0.0.1:{}/?room={code}\n", server.port));
    assert!(code.len() == 6 && server.try_enter(code, None).is_ok());
    let mut loud = microsim(&["serve", "--port", "0", "--listen", "127.0.0.1"]);
    let mut process = loud.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(process.stderr.take().unwrap()).lines().map(Result::unwrap);
    let picture: Vec<String> = lines.by_ref().take_while(|line| !line.contains("Ctrl-C")).collect();
    process.kill().unwrap();
    process.wait().unwrap();
    assert!(picture.len() > 12 && picture.iter().all(|line| line.chars().count() == picture[0].chars().count()));
    refused(&["serve", "--listen", "127.0.0.1", "--port", &server.port.to_string()], "cannot listen at 127.0.0.1:");
    refused(&["serve", "--rooms", "0"], "1..=100000");
    refused(&["serve", "--key", "key.pem"], "--certificate");
}

#[cfg(target_os = "linux")]
fn resident_kb(server: &Server) -> f64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", server.process.id())).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    line.trim().trim_end_matches(" kB").parse().unwrap()
}

/// What a room takes, and how much the server carries with the guests of this one thread beside it.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "measures: prints memory and messages"]
fn load() {
    const TIME: Duration = Duration::from_secs(10);
    let server = Server::start(&[]);
    let empty = resident_kb(&server);
    let mut rooms: Vec<Vec<Guest>> =
        (0..200).map(|k| (0..4).map(|_| server.enter(&format!("ROOM{k}"))).collect()).collect();
    std::thread::sleep(Duration::from_secs(1));
    println!("{:.1} MB without rooms, {:.0} kB a room of four", empty / 1e3, (resident_kb(&server) - empty) / 200.0);
    // Numbers are given in the order of arrival, which may not be that of the vector.
    let mut numbers = Vec::new();
    for guest in rooms.iter_mut().flatten() {
        numbers.push(guest.next().unwrap()[2]);
        guest.0.get_ref().set_nonblocking(true).unwrap();
    }
    for active in [10, 50, 200] {
        let (mut come, mut sent, begin) = (0u64, 0u64, Instant::now());
        while begin.elapsed() < TIME {
            for (guest, number) in rooms[..active].iter_mut().flatten().zip(&numbers) {
                while let Ok(message) = guest.0.read() {
                    come += u64::from(message.len() == 61);
                }
                let message = [&[(number + 1) % 4][..], &[0; 60]].concat();
                sent += u64::from(guest.0.send(Message::binary(message)).is_ok());
            }
        }
        println!("{active} rooms: {sent} sent, {come} carried in {TIME:?}");
    }
}
