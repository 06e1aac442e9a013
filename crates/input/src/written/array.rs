//! Arrays of a fixed length in TOML files. serde takes the first entries of a longer array and says
//! nothing about the rest; here the length must be right.

use serde::{Deserialize, Deserializer, de::Error};
use toml::Spanned;

struct Exactly<T, const N: usize>([T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let entries = Vec::<T>::deserialize(deserializer)?;
        let found = entries.len();
        let wrong_length = |_| D::Error::custom(format!("expected an array of {N}, found {found} entries"));
        entries.try_into().map(Self).map_err(wrong_length)
    }
}

/// For `deserialize_with`: an array of `N` entries, no more and no fewer.
///
/// # Errors
/// Another number of entries, or an entry that is no `T`.
pub fn fixed_array<'de, D, T, const N: usize>(deserializer: D) -> Result<Option<Spanned<[T; N]>>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    let written = Spanned::<Exactly<T, N>>::deserialize(deserializer)?;
    Ok(Some(Spanned::new(written.span(), written.into_inner().0)))
}

/// A square matrix by rows.
type Square<const N: usize> = [[f64; N]; N];

/// For `deserialize_with`: a matrix of `N` rows of `N` entries.
///
/// # Errors
/// Another number of rows or of entries in a row.
pub(crate) fn fixed_matrix<'de, D, const N: usize>(
    deserializer: D,
) -> Result<Option<Spanned<Square<N>>>, D::Error>
where
    D: Deserializer<'de>,
{
    let written: Option<Spanned<[Exactly<f64, N>; N]>> = fixed_array(deserializer)?;
    Ok(written.map(|rows| Spanned::new(rows.span(), rows.into_inner().map(|row| row.0))))
}
