//! The learning curve as a table.

use super::Point;

/// A line a point under a line of names.
pub fn table(curve: &[Point]) -> String {
    let mut table = String::from("step,seconds,loss,epsilon,total,gap,feasible\n");
    for p in curve {
        table += &format!(
            "{},{:.1},{:.6},{:.4},{:.4},{:.6},{:.4}\n",
            p.step, p.seconds, p.loss, p.epsilon, p.total, p.gap, p.feasible
        );
    }
    table
}
