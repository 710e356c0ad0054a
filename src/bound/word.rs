//! Words: the parts of a face under repeated quartering.

use std::fmt;
use std::str::FromStr;

use super::shape::Shape;
use crate::scheme::Tile;

/// A part of the parameter domain of a face, one letter 0, 1, 2, 3 for each level: 0 keeps the
/// quarter at corner 0, the others take the [`Tile`]s.
///
/// Words of zeros only are *extraordinary*: their net has the extraordinary vertex at corner 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Word {
    len: u8,
    /// Two bits for each letter, the first letter lowest.
    letters: u64,
}

/// The most letters of a word.
pub const LONGEST_WORD: usize = 30;

impl Word {
    /// The whole face.
    pub const EMPTY: Word = Word { len: 0, letters: 0 };

    /// `0` repeated.
    ///
    /// # Panics
    /// Beyond [`LONGEST_WORD`].
    pub fn zeros(len: usize) -> Self {
        assert!(len <= LONGEST_WORD);
        Word {
            len: len as u8,
            letters: 0,
        }
    }

    /// Number of letters: the level.
    pub fn len(self) -> usize {
        usize::from(self.len)
    }

    /// Whether this is the whole face.
    pub fn is_empty(self) -> bool {
        self.len == 0
    }

    /// Letter `i` from the front.
    pub fn letter(self, i: usize) -> u8 {
        (self.letters >> (2 * i) & 3) as u8
    }

    /// The letters.
    pub fn letters(self) -> impl Iterator<Item = u8> {
        (0..self.len()).map(move |i| self.letter(i))
    }

    /// Whether the net of the part has the extraordinary vertex: zeros only.
    pub fn is_extraordinary(self) -> bool {
        self.letters == 0
    }

    /// One letter more.
    ///
    /// # Panics
    /// Beyond [`LONGEST_WORD`].
    pub fn child(self, letter: u8) -> Self {
        assert!(self.len() < LONGEST_WORD && letter < 4);
        Word {
            len: self.len + 1,
            letters: self.letters | u64::from(letter) << (2 * self.len),
        }
    }

    /// The first `len` letters.
    pub fn prefix(self, len: usize) -> Self {
        let len = len.min(self.len());
        Word {
            len: len as u8,
            letters: self.letters & ((1u64 << (2 * len)) - 1),
        }
    }

    /// All but the last letter, and the last letter.
    pub fn split_last(self) -> Option<(Self, u8)> {
        let last = self.len().checked_sub(1)?;
        Some((self.prefix(last), self.letter(last)))
    }

    /// The image under the exchange of v and w: 1 and 3 change places.
    pub fn mirror(self) -> Self {
        // 1 = 01 and 3 = 11: letters with the low bit set flip their high bit.
        let low = self.letters & 0x5555_5555_5555_5555;
        Word {
            len: self.len,
            letters: self.letters ^ (low << 1),
        }
    }

    /// How many zeros the word begins with.
    pub fn leading_zeros(self) -> usize {
        self.letters().take_while(|&letter| letter == 0).count()
    }
}

/// The tile of a letter 1, 2, 3.
pub(super) fn tile(letter: u8) -> Option<Tile> {
    match letter {
        1 => Some(Tile::First),
        2 => Some(Tile::Second),
        3 => Some(Tile::Third),
        _ => None,
    }
}

impl Word {
    /// The corners of the part in the parameters of its first `from` letters, as integers over
    /// 2^(len - from).
    pub fn corners_within(self, shape: Shape, from: usize) -> Vec<[i64; 2]> {
        let side = 1i64 << (self.len() - from);
        let unit = shape.corners().iter();
        let mut corners: Vec<[i64; 2]> = unit.map(|corner| corner.map(|x| x * side)).collect();
        for i in from..self.len() {
            // The axes run from corner 0 to corner 1 and to the last corner.
            let (p0, p1, p2) = (corners[0], corners[1], corners[corners.len() - 1]);
            let at = |&[v, w]: &[i64; 2]| {
                std::array::from_fn(|k| p0[k] + (v * (p1[k] - p0[k]) + w * (p2[k] - p0[k])) / 2)
            };
            corners = shape.quarter(self.letter(i)).iter().map(at).collect();
        }
        corners
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.letters().try_for_each(|letter| write!(f, "{letter}"))
    }
}

impl FromStr for Word {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.len() > LONGEST_WORD {
            return Err(format!("a word has at most {LONGEST_WORD} letters: {text}"));
        }
        text.bytes().try_fold(Word::EMPTY, |word, byte| match byte {
            b'0'..=b'3' => Ok(word.child(byte - b'0')),
            _ => Err(format!("the letters of a word are 0, 1, 2, 3: {text}")),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_mirror_letter_by_letter() {
        let word: Word = "0123310".parse().unwrap();
        assert_eq!(word.mirror().to_string(), "0321130");
        assert_eq!(word.mirror().mirror(), word);
        assert_eq!(word.prefix(3).to_string(), "012");
        assert_eq!(word.leading_zeros(), 1);
    }

    #[test]
    fn the_corners_of_a_mirrored_part_are_exchanged() {
        for text in ["1", "2", "012", "0321", "2213"] {
            let word: Word = text.parse().unwrap();
            let swap = |[v, w]: [i64; 2]| [w, v];
            let corners = |word: Word, shape| word.corners_within(shape, 0);
            let [p0, p1, p2] = corners(word, Shape::Triangle)[..] else {
                panic!("a triangle")
            };
            assert_eq!(
                corners(word.mirror(), Shape::Triangle),
                [p0, p2, p1].map(swap)
            );
            let [p0, p1, p2, p3] = corners(word, Shape::Bicubic)[..] else {
                panic!("a square")
            };
            assert_eq!(
                corners(word.mirror(), Shape::Bicubic),
                [p0, p3, p2, p1].map(swap)
            );
        }
    }
}
