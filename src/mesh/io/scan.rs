//! Words of a text file, with the line they stand on.

/// Where a file is wrong, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// Line, from 1; `None` where lines have no meaning.
    pub line: Option<u32>,
    /// What is wrong and the cure.
    pub what: String,
}

impl Fault {
    pub fn new(line: u32, what: impl Into<String>) -> Self {
        Self {
            line: Some(line),
            what: what.into(),
        }
    }
}

/// A cursor over the words of a file.
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    position: usize,
    line: u32,
    /// Whether a backslash joins a line to the next.
    continues: bool,
}

impl<'a> Scanner<'a> {
    /// A cursor at the start, behind a byte order mark if there is one.
    pub fn new(bytes: &'a [u8], continues: bool) -> Self {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        Self::inside(bytes, continues)
    }

    /// A cursor at the start of a part of a file.
    pub fn inside(bytes: &'a [u8], continues: bool) -> Self {
        Self {
            bytes,
            position: 0,
            line: 1,
            continues,
        }
    }

    /// The line of the cursor, from 1.
    #[inline]
    pub fn line(&self) -> u32 {
        self.line
    }

    /// Number of bytes not yet read.
    pub fn remaining(&self) -> usize {
        self.bytes.len() - self.position
    }

    /// The bytes not yet read.
    #[inline]
    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.position..]
    }

    /// Goes behind a line of so many bytes.
    #[inline]
    pub fn pass_line(&mut self, length: usize) {
        self.position += length;
        self.line += 1;
    }

    /// Goes to the next word of this line, comments apart; false if there is none.
    #[inline]
    pub fn at_word(&mut self) -> bool {
        while let Some(&c) = self.bytes.get(self.position) {
            match c {
                b' ' | b'\t' | b'\r' | b'\x0b' | b'\x0c' => self.position += 1,
                b'\n' | b'#' => return false,
                b'\\' if self.joins() => self.skip_join(),
                _ => return true,
            }
        }
        false
    }

    /// The next word of this line, comments apart.
    #[inline]
    pub fn word(&mut self) -> Option<&'a [u8]> {
        if !self.at_word() {
            return None;
        }
        let rest = &self.bytes[self.position..];
        let ends = |&c: &u8| c <= b' ' && matches!(c, b' ' | b'\t' | b'\n' | b'\r' | 11 | 12);
        let mut length = rest.iter().position(ends).unwrap_or(rest.len());
        // A join may follow a word without a space.
        if self.continues && rest[length - 1] == b'\\' && length > 1 {
            let joined = matches!(rest[length..], [b'\n', ..] | [b'\r', b'\n', ..]);
            length -= usize::from(joined);
        }
        self.position += length;
        Some(&rest[..length])
    }

    /// Goes to the next line; false at the end of the file.
    #[inline]
    pub fn next_line(&mut self) -> bool {
        let mut comment = false;
        while let Some(&c) = self.bytes.get(self.position) {
            match c {
                b'\n' => {
                    self.position += 1;
                    self.line += 1;
                    return true;
                }
                b'\\' if !comment && self.joins() => self.skip_join(),
                _ => {
                    comment |= c == b'#';
                    self.position += 1;
                }
            }
        }
        false
    }

    /// The next word of this line or a later one.
    pub fn word_anywhere(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.word() {
                return Some(word);
            }
            if !self.next_line() {
                return None;
            }
        }
    }

    /// Whether the backslash at the cursor ends its line.
    fn joins(&self) -> bool {
        let after = &self.bytes[self.position + 1..];
        self.continues && matches!(after, [b'\n', ..] | [b'\r', b'\n', ..])
    }

    fn skip_join(&mut self) {
        self.position += if self.bytes[self.position + 1] == b'\n' {
            2
        } else {
            3
        };
        self.line += 1;
    }
}

/// A word for a message: printable and short.
pub(super) fn quote(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(40)]);
    let mut quoted: String = text
        .chars()
        .map(|c| if c.is_control() { '?' } else { c })
        .collect();
    if word.len() > 40 {
        quoted.push('…');
    }
    format!("'{quoted}'")
}

/// A whole number in decimal digits, with sign.
#[inline]
pub(super) fn integer(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0i64;
    for &c in digits {
        let digit = c.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        value = value * 10 + i64::from(digit);
    }
    Some(if negative { -value } else { value })
}
