//! The weights of the messages between candidates: a kernel of the travel time with normalised rows.

/// `exp(-e / scale)` for the `n x n` travel times `edges`, its rows normalised to 1, written over `kernel`.
pub fn kernel(edges: &[f32], n: usize, scale: f32, kernel: &mut Vec<f32>) {
    let factor = -1.0 / scale;
    kernel.clear();
    kernel.extend(edges.iter().map(|e| (e * factor).exp()));
    for row in kernel.chunks_exact_mut(n.max(1)) {
        let sum: f32 = row.iter().sum();
        row.iter_mut().for_each(|k| *k /= sum);
    }
}
