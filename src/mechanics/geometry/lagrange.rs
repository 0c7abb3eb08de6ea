//! Lagrange polynomials on elements, as in classical finite elements.

use serde::{Deserialize, Serialize};

use super::error::finite;
use super::knots::{check_degree, check_inside, check_span_lengths, check_spans};
use super::values::{BasisValues, FunctionRow};
use super::{GeometryError, Span};

/// Largest degree of Lagrange elements. Equally spaced nodes are unsuitable for higher degrees.
const LARGEST_DEGREE: usize = 3;

/// Continuous piecewise Lagrange polynomials with `degree + 1` equally spaced nodes per element.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(usize, Vec<f64>)")]
pub struct LagrangeBasis {
    degree: usize,
    breaks: Vec<f64>,
}

impl TryFrom<(usize, Vec<f64>)> for LagrangeBasis {
    type Error = GeometryError;

    fn try_from((degree, breaks): (usize, Vec<f64>)) -> Result<Self, GeometryError> {
        Self::new(degree, breaks)
    }
}

impl LagrangeBasis {
    /// Creates elements of `degree` 1 to 3 between consecutive `breaks` (dimensionless, increasing).
    ///
    /// # Errors
    /// Fails for a degree out of range, fewer than two breaks, and breaks that are not finite or not increasing.
    /// Fails for spans shorter than 1e-12 of the domain, or more than [`MAX_SPANS`](super::MAX_SPANS) elements.
    pub fn new(degree: usize, breaks: Vec<f64>) -> Result<Self, GeometryError> {
        check_degree(degree, LARGEST_DEGREE)?;
        check_spans(breaks.len().saturating_sub(1))?;
        for (index, &value) in breaks.iter().enumerate() {
            finite(format!("break {index}"), value)?;
        }
        for (index, pair) in breaks.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                return Err(GeometryError::BreakOrder {
                    index: index + 1,
                    value: pair[1],
                    previous: pair[0],
                });
            }
        }
        check_span_lengths("breaks", &breaks)?;
        Ok(Self { degree, breaks })
    }

    /// Creates `elements` equal elements of `degree` 1 to 3 on `[0, 1]`.
    ///
    /// # Errors
    /// Fails for `elements` outside 1 to [`MAX_SPANS`](super::MAX_SPANS), or `degree` outside 1 to 3.
    pub fn uniform(elements: usize, degree: usize) -> Result<Self, GeometryError> {
        check_spans(elements)?;
        Self::new(degree, (0..=elements).map(|i| i as f64 / elements as f64).collect())
    }

    /// Polynomial degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of functions, one per node.
    pub fn functions(&self) -> usize {
        (self.breaks.len() - 1) * self.degree + 1
    }

    /// First and last break [-].
    pub fn domain(&self) -> (f64, f64) {
        (self.breaks[0], self.breaks[self.breaks.len() - 1])
    }

    /// Ends of the elements [-], in order.
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Elements as spans, in order.
    pub fn spans(&self) -> Vec<Span> {
        (0..self.breaks.len() - 1).map(|element| self.span(element)).collect()
    }

    /// Element that contains the parameter `xi` [-]; at a break, the element on the right.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN.
    pub fn span_at(&self, xi: f64) -> Result<Span, GeometryError> {
        let (start, end) = self.domain();
        check_inside(xi, start, end)?;
        let behind = self.breaks.partition_point(|&value| value <= xi);
        Ok(self.span(behind.min(self.breaks.len() - 1) - 1))
    }

    /// Parameters of the nodes [-]. Each function is 1 at its node and 0 at all other nodes.
    pub fn nodes(&self) -> Vec<f64> {
        let mut nodes = vec![self.breaks[0]];
        for span in self.spans() {
            nodes.extend((1..=self.degree).map(|j| self.node(&span, j)));
        }
        nodes
    }

    /// Returns the basis with the element that contains `xi` split at `xi`.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or too close to a break, or if there would be too many elements.
    pub fn split(&self, xi: f64) -> Result<Self, GeometryError> {
        let (start, end) = self.domain();
        check_inside(xi, start, end)?;
        let behind = self.breaks.partition_point(|&value| value <= xi);
        let mut breaks = self.breaks.clone();
        breaks.insert(behind, xi);
        Self::new(self.degree, breaks)
    }

    pub(crate) fn evaluate_in(&self, span: &Span, xi: f64) -> BasisValues {
        let mut basis = BasisValues::zeros(span.first, self.degree);
        self.fill(span, xi, basis.rows_mut());
        basis
    }

    pub(super) fn fill<const WIDTH: usize>(&self, span: &Span, xi: f64, rows: &mut [[f64; WIDTH]]) {
        for j in 0..=self.degree {
            let derivatives = self.polynomial(span, j, xi);
            rows.iter_mut().zip(derivatives).for_each(|(row, derivative)| row[j] = derivative);
        }
    }

    fn polynomial(&self, span: &Span, j: usize, xi: f64) -> FunctionRow {
        let mut derivatives = FunctionRow::default();
        derivatives[0] = 1.0;
        for m in (0..=self.degree).filter(|&m| m != j) {
            let distance = self.node(span, j) - self.node(span, m);
            let factor = (xi - self.node(span, m)) / distance;
            for k in (1..=self.degree).rev() {
                derivatives[k] = factor * derivatives[k] + k as f64 / distance * derivatives[k - 1];
            }
            derivatives[0] *= factor;
        }
        derivatives
    }

    fn span(&self, element: usize) -> Span {
        Span {
            first: element * self.degree,
            start: self.breaks[element],
            end: self.breaks[element + 1],
        }
    }

    /// Parameter of node `j` of an element. The end nodes are exactly the breaks.
    fn node(&self, span: &Span, j: usize) -> f64 {
        let t = j as f64 / self.degree as f64;
        (1.0 - t) * span.start + t * span.end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_function_is_one_at_its_node_and_zero_at_the_others() {
        for degree in 1..=3 {
            let basis = LagrangeBasis::new(degree, vec![-0.3, 0.1, 0.8]).unwrap();
            let nodes = basis.nodes();
            assert_eq!(nodes.len(), basis.functions());
            for (index, &node) in nodes.iter().enumerate() {
                let values = basis.evaluate_in(&basis.span_at(node).unwrap(), node);
                for (j, &value) in values.values().iter().enumerate() {
                    assert_eq!(value, if values.first + j == index { 1.0 } else { 0.0 });
                }
            }
        }
    }

    #[test]
    fn quadratic_elements_have_their_textbook_derivatives() {
        let basis = LagrangeBasis::new(2, vec![-1.0, 1.0]).unwrap();
        let values = basis.evaluate_in(&basis.spans()[0], 0.5);
        assert_eq!(values.values(), [-0.125, 0.75, 0.375]);
        assert_eq!(values.slopes(), [0.0, -1.0, 1.0]);
        assert_eq!(values.derivatives(2), [1.0, -2.0, 1.0]);
    }

    #[test]
    fn splitting_a_lagrange_basis_adds_one_element() {
        let basis = LagrangeBasis::uniform(2, 3).unwrap().split(0.3).unwrap();
        assert_eq!(basis.breaks(), [0.0, 0.3, 0.5, 1.0]);
        assert_eq!(basis.functions(), 10);
        assert!(matches!(basis.split(0.5), Err(GeometryError::BreakOrder { .. })));
        assert!(matches!(basis.split(f64::NAN), Err(GeometryError::OutsideDomain { .. })));
    }

    #[test]
    fn invalid_lagrange_elements_are_rejected() {
        let refusal = |degree, breaks: &[f64]| {
            LagrangeBasis::new(degree, breaks.to_vec()).unwrap_err().to_string()
        };
        assert_eq!(refusal(0, &[0.0, 1.0]), "degree 0 is not available; allowed are 1 to 3");
        assert_eq!(refusal(4, &[0.0, 1.0]), "degree 4 is not available; allowed are 1 to 3");
        assert_eq!(refusal(1, &[]), "spans: 0 requested, but 1 to 400000 are allowed");
        assert_eq!(refusal(1, &[f64::NAN, 1.0]), "break 0 is NaN, but must be a finite number");
        assert_eq!(
            refusal(1, &[0.0, 0.5, 0.5]),
            "breaks: entry 2 (0.5) is not larger than entry 1 (0.5); breaks must increase"
        );
        assert!(refusal(1, &[0.0, 1e-14, 1.0]).contains("shorter than 1e-12"));
        assert!(LagrangeBasis::uniform(0, 1).is_err());
        assert!(LagrangeBasis::uniform(usize::MAX, 1).is_err());
    }
}
