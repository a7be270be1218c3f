//! The learning curve as a drawing: gap, infeasible share, loss and epsilon over the steps.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::error::{Error, Result};

use super::Point;

const SIZE: (u32, u32) = (900, 640);

/// An SVG document of four panels.
pub fn chart(title: &str, curve: &[Point]) -> Result<String> {
    let mut document = String::new();
    draw(&mut document, title, curve).map_err(|e| Error::Curve(e.to_string()))?;
    Ok(document)
}

type Drawn = std::result::Result<(), Box<dyn std::error::Error>>;

fn draw(document: &mut String, title: &str, curve: &[Point]) -> Drawn {
    let area = SVGBackend::with_string(document, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let area = area.titled(title, ("sans-serif", 20))?;
    let panels = area.split_evenly((2, 2));
    let of = |value: fn(&Point) -> f64| {
        let pairs = curve.iter().map(|p| (p.step as f64, value(p)));
        pairs.filter(|(_, v)| v.is_finite()).collect::<Vec<_>>()
    };
    panel(&panels[0], "gap in %", &of(|p| 100.0 * p.gap))?;
    panel(&panels[1], "without a tour in %", &of(|p| 100.0 * (1.0 - p.feasible)))?;
    panel(&panels[2], "loss", &of(|p| p.loss))?;
    panel(&panels[3], "epsilon", &of(|p| p.epsilon))?;
    area.present()?;
    Ok(())
}

fn panel(area: &DrawingArea<SVGBackend<'_>, Shift>, name: &str, points: &[(f64, f64)]) -> Drawn {
    let steps = points.iter().map(|p| p.0).fold(1.0, f64::max);
    let most = points.iter().map(|p| p.1).fold(0.0, f64::max).max(1e-6);
    let mut chart = ChartBuilder::on(area)
        .caption(name, ("sans-serif", 15))
        .margin(10)
        .x_label_area_size(25)
        .y_label_area_size(55)
        .build_cartesian_2d(0.0..steps, 0.0..1.05 * most)?;
    chart.configure_mesh().light_line_style(TRANSPARENT).x_labels(6).draw()?;
    chart.draw_series(LineSeries::new(points.iter().copied(), &BLUE))?;
    Ok(())
}
