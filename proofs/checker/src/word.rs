//! Words: their mirror images, and which are regular.

/// The mirrored word.
pub fn mirrored(word: &[u8]) -> Vec<u8> {
    word.iter().map(|&letter| if letter % 2 == 1 { 4 - letter } else { letter }).collect()
}

/// True for a word with a letter other than 0.
pub fn is_regular(word: &[u8]) -> bool {
    word.iter().any(|&letter| letter != 0)
}

/// True for `0^r m`, r >= 0, m = 1, 2, 3.
pub fn is_tile(word: &[u8]) -> bool {
    word.split_last().is_some_and(|(&last, zeros)| last != 0 && !is_regular(zeros))
}
