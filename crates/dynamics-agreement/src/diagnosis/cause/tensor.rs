//! Mistakes with the six entries of an inertia tensor.

use nalgebra::Matrix3;

use super::common_mistake::CommonMistake;
use crate::{
    diagnosis::{cause_names::DynamicsCause, free::ENTRIES, hypothesis::FaultySide},
    model::Inertial,
};

const PRODUCTS: [(&str, (usize, usize)); 3] = [("ixy", (0, 1)), ("ixz", (0, 2)), ("iyz", (1, 2))];
const MOMENTS: [(&str, usize); 3] = [("ixx", 0), ("iyy", 1), ("izz", 2)];
const MOMENT_PAIRS: [(&str, [usize; 2]); 3] = [("ixx_iyy", [0, 1]), ("ixx_izz", [0, 2]), ("iyy_izz", [1, 2])];
const PRODUCT_PAIRS: [(&str, [usize; 2]); 3] =
    [("ixy_ixz", [0, 1]), ("ixy_iyz", [0, 2]), ("ixz_iyz", [1, 2])];

/// For each of the six entries of a URDF, `xx xy xz yy yz zz`, the index of the right entry that was written there.
const ORDERS: [(&str, [usize; 6]); 3] = [
    // xx yy zz xy xz yz
    ("diagonal_first", [0, 3, 5, 1, 2, 4]),
    // xx yy zz yz xz xy
    ("diagonal_first_voigt", [0, 3, 5, 4, 2, 1]),
    // xx xy yy xz yz zz
    ("column_major", [0, 1, 3, 2, 4, 5]),
];
/// The first six of nine entries by rows, `xx xy xz xy yy yz`: the last moment is lost.
const BY_ROWS: [usize; 6] = [0, 1, 2, 1, 3, 4];

pub(super) fn mistakes<'a>(faulty: FaultySide) -> Vec<CommonMistake<'a>> {
    let towards_written = match faulty {
        FaultySide::Candidate => 1.0,
        FaultySide::Reference => -1.0,
    };
    let mut mistakes = vec![
        tensor_mistake(DynamicsCause::ProductsSign, "", |tensor| {
            // Diagonal kept, off-diagonal entries negated: the product of inertia is defined with either sign in
            // use.
            Matrix3::from_diagonal(&tensor.diagonal()) * 2.0 - tensor
        }),
        about_origin("", -towards_written),
        about_origin("reverse", towards_written),
    ];
    for (name, entry) in PRODUCTS {
        mistakes.push(tensor_mistake(DynamicsCause::ProductSign, name, move |tensor| {
            let mut changed = *tensor;
            set(&mut changed, entry, -tensor[entry]);
            changed
        }));
    }
    // Only what a file says can be negative: an importer would have to invent it.
    if faulty == FaultySide::Candidate {
        mistakes.extend(MOMENTS.map(|(name, at)| negative_moment(name, at)));
    }
    for (name, [a, b]) in MOMENT_PAIRS {
        mistakes.push(tensor_mistake(DynamicsCause::MomentsSwapped, name, move |tensor| {
            exchanged(tensor, (a, a), (b, b))
        }));
    }
    for (name, [a, b]) in PRODUCT_PAIRS {
        mistakes.push(tensor_mistake(DynamicsCause::ProductsSwapped, name, move |tensor| {
            exchanged(tensor, PRODUCTS[a].1, PRODUCTS[b].1)
        }));
    }
    for (name, order) in ORDERS {
        mistakes.push(tensor_mistake(DynamicsCause::InertiaOrder, name, move |tensor| {
            reordered(faulty, order, tensor)
        }));
    }
    // Undone it would need the lost moment: for the candidate `put_back_from_rows` makes it a free parameter.
    if faulty == FaultySide::Reference {
        mistakes.push(tensor_mistake(DynamicsCause::InertiaOrder, "row_major_upper", |tensor| {
            reordered(FaultySide::Reference, BY_ROWS, tensor)
        }));
    }
    for turn in quarter_turns() {
        mistakes.push(tensor_mistake(DynamicsCause::InertiaRotation, "quarter", move |tensor| {
            turn * tensor * turn.transpose()
        }));
    }
    mistakes
}

/// The parameters of a file in which nine entries by rows were cut to six, with zero for the moment that is lost.
pub(super) fn put_back_from_rows(parameters: &Inertial) -> Inertial {
    let mut tensor = reordered(FaultySide::Candidate, BY_ROWS, &parameters.tensor_kg_m2);
    // The file does not have this moment; the caller makes it the one free parameter.
    tensor[(2, 2)] = 0.0;
    Inertial { tensor_kg_m2: tensor, ..*parameters }
}

/// Whether the six entries could be the first six of nine by rows.
pub(super) fn could_be_by_rows(parameters: &Inertial) -> bool {
    let tensor = &parameters.tensor_kg_m2;
    let scale = tensor.amax() * crate::thresholds::SAME_VALUE;
    // Written by rows the list is xx xy xz xy yy yz, so the values read as ixy and iyy are the same number.
    (tensor[(0, 1)] - tensor[(1, 1)]).abs() <= scale && tensor[(1, 2)] != 0.0
}

/// A moment with a wrong sign: no moment of inertia is negative.
fn negative_moment<'a>(name: &str, at: usize) -> CommonMistake<'a> {
    CommonMistake::at_link(DynamicsCause::MomentSign, name, move |_, parameters| {
        let mut tensor = parameters.tensor_kg_m2;
        tensor[(at, at)] = tensor[(at, at)].abs();
        (parameters.tensor_kg_m2[(at, at)] < 0.0).then_some(Inertial { tensor_kg_m2: tensor, ..*parameters })
    })
}

fn tensor_mistake<'a>(
    cause: DynamicsCause,
    detail: &str,
    change: impl Fn(&Matrix3<f64>) -> Matrix3<f64> + 'a,
) -> CommonMistake<'a> {
    CommonMistake::new(cause, detail, move |parameters| Inertial {
        tensor_kg_m2: change(&parameters.tensor_kg_m2),
        ..*parameters
    })
}

/// Adds the parallel-axis term times `sign`: +1 from the centre of mass to the origin, -1 back.
fn about_origin<'a>(detail: &str, sign: f64) -> CommonMistake<'a> {
    CommonMistake::new(DynamicsCause::InertiaAboutOrigin, detail, move |parameters| {
        parameters.with_tensor_in_link(&(parameters.tensor_in_link() + parameters.shift() * sign))
    })
}

fn set(tensor: &mut Matrix3<f64>, (row, column): (usize, usize), value: f64) {
    tensor[(row, column)] = value;
    tensor[(column, row)] = value;
}

fn exchanged(tensor: &Matrix3<f64>, a: (usize, usize), b: (usize, usize)) -> Matrix3<f64> {
    let mut result = *tensor;
    set(&mut result, a, tensor[b]);
    set(&mut result, b, tensor[a]);
    result
}

fn reordered(faulty: FaultySide, order: [usize; 6], tensor: &Matrix3<f64>) -> Matrix3<f64> {
    let mut result = Matrix3::zeros();
    for (place, taken) in order.into_iter().enumerate() {
        match faulty {
            FaultySide::Candidate => set(&mut result, ENTRIES[taken], tensor[ENTRIES[place]]),
            FaultySide::Reference => set(&mut result, ENTRIES[place], tensor[ENTRIES[taken]]),
        }
    }
    result
}

/// The 23 rotations of a cube without the identity.
fn quarter_turns() -> Vec<Matrix3<f64>> {
    let mut turns = Vec::new();
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
        for signs in 0..8_usize {
            let mut turn = Matrix3::zeros();
            for (row, column) in order.into_iter().enumerate() {
                turn[(row, column)] = if signs >> row & 1 == 1 { -1.0 } else { 1.0 };
            }
            // Signed permutations with determinant 1 are the 24 rotations of a cube; those with -1 are
            // reflections.
            if turn.determinant() > 0.0 && turn != Matrix3::identity() {
                turns.push(turn);
            }
        }
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_are_undone_by_their_reverse() {
        let tensor = Matrix3::new(1.0, 2.0, 3.0, 2.0, 4.0, 5.0, 3.0, 5.0, 6.0);
        for (_, order) in ORDERS {
            let written = reordered(FaultySide::Reference, order, &tensor);
            assert_ne!(written, tensor);
            assert_eq!(reordered(FaultySide::Candidate, order, &written), tensor);
        }
        assert_eq!(quarter_turns().len(), 23);
    }
}
