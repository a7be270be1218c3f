//! Changes of bytes, drawn by proptest so that what fails is made as small as can be.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// What breaks readers more often than chance: ends of ranges, brackets, escapes, bytes that are no text.
const TOKENS: [&[u8]; 22] = [
    b"0",
    b"-1",
    b"-0",
    b"1e308",
    b"1e-320",
    b"NaN",
    b"null",
    b"true",
    b"[",
    b"]",
    b"{",
    b"}",
    b"\"",
    b",",
    b"\\u0000",
    b"%00",
    b"%ff",
    b"\xff",
    b"\xf0\x9f\x9a\x97",
    b"18446744073709551615",
    b"\x80\x80\x80\x80\x10",
    b"\x00",
];
/// Bytes that one change takes away, or repeats, at most.
const STRETCH: usize = 64;

/// One change; places count from the front, around the end.
#[derive(Clone, Debug)]
pub enum Change {
    Set(Index, u8),
    Flip(Index, u8),
    Insert(Index, Vec<u8>),
    Remove(Index, usize),
    /// The stretch once more, elsewhere.
    Copy(Index, usize, Index),
    Cut(Index),
}

pub fn change() -> impl Strategy<Value = Change> {
    let token = select(TOKENS.to_vec()).prop_map(<[u8]>::to_vec);
    let bytes = prop_oneof![token, vec(any::<u8>(), 1..6)];
    prop_oneof![
        (any::<Index>(), any::<u8>()).prop_map(|(at, byte)| Change::Set(at, byte)),
        (any::<Index>(), 0..8_u8).prop_map(|(at, bit)| Change::Flip(at, bit)),
        (any::<Index>(), bytes).prop_map(|(at, bytes)| Change::Insert(at, bytes)),
        (any::<Index>(), 1..STRETCH).prop_map(|(at, length)| Change::Remove(at, length)),
        (any::<Index>(), 1..STRETCH, any::<Index>())
            .prop_map(|(from, length, to)| Change::Copy(from, length, to)),
        any::<Index>().prop_map(Change::Cut),
    ]
}

pub fn applied(seed: &[u8], changes: &[Change]) -> Vec<u8> {
    let mut data = seed.to_vec();
    for change in changes {
        // One place more than there are bytes: the end.
        let place = |at: &Index| at.index(data.len() + 1);
        let stretch = |from: usize, length: usize| from..(from + length).min(data.len());
        match change {
            Change::Set(at, byte) => {
                let at = place(at);
                data.splice(stretch(at, 1), [*byte]);
            }
            Change::Flip(at, bit) => {
                let at = place(at);
                data.get_mut(at).into_iter().for_each(|byte| *byte ^= 1 << bit);
            }
            Change::Insert(at, bytes) => {
                let at = place(at);
                data.splice(at..at, bytes.iter().copied());
            }
            Change::Remove(at, length) => {
                let at = place(at);
                data.drain(stretch(at, *length));
            }
            Change::Copy(from, length, to) => {
                let (from, to) = (place(from), place(to));
                let copied = data[stretch(from, *length)].to_vec();
                data.splice(to..to, copied);
            }
            Change::Cut(at) => {
                let at = place(at);
                data.truncate(at);
            }
        }
    }
    data
}
