//! A table as a drawing: objectives and computing times against what differs, ours in full lines and the paper's
//! dashed.

use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;

use super::{BenchError, Row, Sheet};

const SIZE: (u32, u32) = (1100, 460);

/// The times that the scale shows, in seconds: from a microsecond to a month.
const TIMES_S: (f64, f64) = (1e-6, 2.6e6);

type Drawn = Result<(), Box<dyn std::error::Error>>;
type Points = Vec<(f64, f64)>;

/// An SVG document.
///
/// # Errors
/// It cannot be drawn.
pub fn plot(sheet: &Sheet<'_>) -> Result<String, BenchError> {
    let mut document = String::new();
    draw(&mut document, sheet).map_err(|error| BenchError::Plot {
        table: sheet.table.name.to_owned(),
        problem: error.to_string(),
    })?;
    Ok(document)
}

fn draw(document: &mut String, sheet: &Sheet<'_>) -> Drawn {
    let area = SVGBackend::with_string(document, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let area = area.titled(sheet.table.title, ("sans-serif", 18))?;
    let (left, rest) = area.split_horizontally(470);
    let (right, legend) = rest.split_horizontally(470);
    let measure = sheet.table.measure;
    let lines = lines(sheet, |row| {
        (row.summary.mean_objective.map(|f| measure.of(f)), row.published.objective)
    });
    let most = lines.iter().flat_map(Line::values).fold(0.0, f64::max).max(1e-6);
    panel(&left, measure.name(), sheet, &lines, 0.0..1.05 * most)?;
    let lines = self::lines(sheet, |row| (Some(row.summary.median_s), row.published.seconds));
    let lines: Vec<Line> = lines.into_iter().map(Line::clamped).collect();
    let values = || lines.iter().flat_map(Line::values);
    let least = values().fold(TIMES_S.1, f64::min) / 2.0;
    let most = values().fold(TIMES_S.0, f64::max) * 2.0;
    panel(&right, "computing time, s", sheet, &lines, (least..most).log_scale())?;
    name(&legend, &lines)?;
    area.present()?;
    Ok(())
}

/// One algorithm: ours, and the paper's.
struct Line {
    name: String,
    color: RGBColor,
    ours: Points,
    theirs: Points,
}

impl Line {
    fn values(&self) -> impl Iterator<Item = f64> {
        self.ours.iter().chain(&self.theirs).map(|point| point.1)
    }

    /// With no time outside the scale.
    fn clamped(mut self) -> Self {
        for (_, value) in self.ours.iter_mut().chain(&mut self.theirs) {
            *value = value.clamp(TIMES_S.0, TIMES_S.1);
        }
        self
    }
}

fn lines(sheet: &Sheet<'_>, of: impl Fn(&Row) -> (Option<f64>, Option<f64>)) -> Vec<Line> {
    let mut names: Vec<&str> = Vec::new();
    for row in &sheet.rows {
        // Where only the step of app differs, its rows are one line.
        let name = base(&row.summary.algorithm);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let line = |(i, name): (usize, &str)| {
        let rows = || sheet.rows.iter().filter(|row| base(&row.summary.algorithm) == name);
        let ours = rows().filter_map(|row| Some((row.x, of(row).0?))).collect();
        let theirs = rows().filter_map(|row| Some((row.x, of(row).1?))).collect();
        Line { name: name.to_owned(), color: COLORS[i % COLORS.len()], ours, theirs }
    };
    names.into_iter().enumerate().map(line).collect()
}

fn base(algorithm: &str) -> &str {
    let step = |tail: &str| tail.bytes().all(|byte| byte.is_ascii_digit());
    algorithm.rsplit_once('-').filter(|(_, tail)| step(tail)).map_or(algorithm, |(name, _)| name)
}

/// Told apart by lightness as well as by hue.
const COLORS: [RGBColor; 10] = [
    RGBColor(0x1b, 0x9e, 0x77),
    RGBColor(0xd9, 0x5f, 0x02),
    RGBColor(0x75, 0x70, 0xb3),
    RGBColor(0xe7, 0x29, 0x8a),
    RGBColor(0x66, 0xa6, 0x1e),
    RGBColor(0xe6, 0xab, 0x02),
    RGBColor(0xa6, 0x76, 0x1d),
    RGBColor(0x1f, 0x78, 0xb4),
    RGBColor(0x22, 0x22, 0x22),
    RGBColor(0x99, 0x99, 0x99),
];

fn panel<Y>(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    label: &str,
    sheet: &Sheet<'_>,
    lines: &[Line],
    y: Y,
) -> Drawn
where
    Y: AsRangedCoord<Value = f64>,
    Y::CoordDescType: ValueFormatter<f64>,
{
    let xs = || sheet.table.settings.iter().map(|setting| setting.x);
    let (least, most) = (xs().fold(f64::INFINITY, f64::min), xs().fold(0.0, f64::max));
    let margin = 0.05 * (most - least).max(1e-6);
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .x_label_area_size(40)
        .y_label_area_size(70)
        .build_cartesian_2d(least - margin..most + margin, y)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc(sheet.table.varied)
        .y_desc(label)
        .x_labels(6)
        .draw()?;
    for line in lines {
        let style = line.color.stroke_width(2);
        chart.draw_series(LineSeries::new(line.ours.iter().copied(), style))?;
        chart.draw_series(line.ours.iter().map(|&at| Circle::new(at, 3, line.color.filled())))?;
        let theirs = line.theirs.iter().copied();
        chart.draw_series(DashedLineSeries::new(theirs, 5, 4, line.color.stroke_width(1)))?;
        chart.draw_series(line.theirs.iter().map(|&at| Circle::new(at, 3, line.color)))?;
    }
    Ok(())
}

/// Which color is whose.
fn name(area: &DrawingArea<SVGBackend<'_>, Shift>, lines: &[Line]) -> Drawn {
    const STEP: i32 = 22;
    let mut y = 20;
    for line in lines {
        area.draw(&PathElement::new([(5, y), (25, y)], line.color.stroke_width(2)))?;
        area.draw(&Text::new(line.name.clone(), (32, y - 7), ("sans-serif", 13)))?;
        y += STEP;
    }
    area.draw(&Text::new("dashed: the paper's", (5, y - 7), ("sans-serif", 12)))?;
    Ok(())
}
