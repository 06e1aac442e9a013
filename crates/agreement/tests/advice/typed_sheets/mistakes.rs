//! Mistakes of a person who types a table.

use std::fmt;

use congruent_description::DhConvention;

use super::{
    Random,
    sheet::{Sheet, Typed},
};

/// A mistake that people make.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Mistake {
    TransposedDigits,
    ExchangedValues,
    Sign,
    ShiftedColumn,
    Radians,
    Millimetres,
    Convention,
    DroppedFlange,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TransposedDigits => "transposed digits",
            Self::ExchangedValues => "two values exchanged",
            Self::Sign => "a row's sign",
            Self::ShiftedColumn => "a column shifted",
            Self::Radians => "radians as degrees",
            Self::Millimetres => "millimetres as metres",
            Self::Convention => "the other convention",
            Self::DroppedFlange => "a dropped flange",
        })
    }
}

impl Mistake {
    pub(super) const ALL: [Self; 8] = [
        Self::TransposedDigits,
        Self::ExchangedValues,
        Self::Sign,
        Self::ShiftedColumn,
        Self::Radians,
        Self::Millimetres,
        Self::Convention,
        Self::DroppedFlange,
    ];

    /// Makes this mistake in a sheet; `None` if the sheet has no place for it.
    fn make(self, sheet: &mut Sheet, random: &mut Random) -> Option<()> {
        match self {
            Self::TransposedDigits => {
                let typed = any(sheet, random, |typed| {
                    typed.key.ends_with("_mm") && transposed(&typed.text).is_some()
                })?;
                typed.text = transposed(&typed.text)?;
            }
            Self::ExchangedValues => {
                let column = random.below(3);
                let rows = sheet.rows.len();
                let (one, other) = (random.below(rows), random.below(rows));
                let [first, second] = [one, other].map(|row| sheet.rows[row][column].clone());
                if first.text == second.text {
                    return None;
                }
                (sheet.rows[one][column], sheet.rows[other][column]) = (second, first);
            }
            Self::Sign => {
                let typed = any(sheet, random, |typed| typed.value() != 0.0 && !typed.text.ends_with("180"))?;
                typed.text = match typed.text.strip_prefix('-') {
                    Some(positive) => positive.to_owned(),
                    None => format!("-{}", typed.text),
                };
            }
            Self::ShiftedColumn => {
                let column = random.below(3);
                let mut values: Vec<Typed> = sheet.rows.iter().map(|row| row[column].clone()).collect();
                if values.iter().filter(|typed| typed.value() != 0.0).count() < 2 {
                    return None;
                }
                values.rotate_right(1);
                "0".clone_into(&mut values[0].text);
                sheet.rows.iter_mut().zip(values).for_each(|(row, typed)| row[column] = typed);
            }
            Self::Radians => {
                let typed = any(sheet, random, |typed| typed.key.ends_with("_deg") && typed.value() != 0.0)?;
                typed.text = format!("{:.4}", typed.value().to_radians());
            }
            Self::Millimetres => {
                let typed = any(sheet, random, |typed| typed.key.ends_with("_mm") && typed.value() != 0.0)?;
                typed.key = if typed.key == "a_mm" { "a_m" } else { "d_m" };
            }
            Self::Convention => {
                sheet.convention = match sheet.convention {
                    DhConvention::Standard => DhConvention::Modified,
                    DhConvention::Modified => DhConvention::Standard,
                }
            }
            Self::DroppedFlange => sheet.flange_mm = None,
        }
        Some(())
    }
}

/// A sheet with this many mistakes of different kinds, `first` among them, and the kinds in it.
pub(super) fn make(
    sheet: &Sheet,
    number: usize,
    first: Option<Mistake>,
    random: &mut Random,
) -> (Sheet, Vec<Mistake>) {
    /// A sheet may have no place for a kind. Kind: loop bound.
    const TRIES: usize = 200;
    let (mut typed, mut made) = (sheet.clone(), Vec::new());
    for _ in 0..TRIES {
        if made.len() == number {
            break;
        }
        let kind = first.unwrap_or_else(|| Mistake::ALL[random.below(Mistake::ALL.len())]);
        if !made.contains(&kind) && kind.make(&mut typed, random).is_some() {
            made.push(kind);
        }
    }
    (typed, made)
}

/// One of the values for which `is_it` holds.
fn any<'a>(
    sheet: &'a mut Sheet,
    random: &mut Random,
    is_it: impl Fn(&Typed) -> bool,
) -> Option<&'a mut Typed> {
    let mut values: Vec<&mut Typed> = sheet.rows.iter_mut().flatten().filter(|typed| is_it(typed)).collect();
    let at = random.below(values.len().max(1));
    (at < values.len()).then(|| values.swap_remove(at))
}

/// The number with its last two neighbouring digits that differ exchanged: 324.5 for 342.5; `None` without such digits.
fn transposed(text: &str) -> Option<String> {
    let mut bytes = text.as_bytes().to_vec();
    let differ = |pair: &[u8]| pair[0] != pair[1] && pair.iter().all(u8::is_ascii_digit);
    // From the right, and never the first digit: a length that is another one at first sight is seen while it is typed.
    let at = (1..bytes.len().saturating_sub(1)).rev().find(|&at| differ(&bytes[at..at + 2]))?;
    bytes.swap(at, at + 1);
    String::from_utf8(bytes).ok()
}
