//! Plots as SVG.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::paper::{Look, Plot, Series};

/// Size in pixels.
const SIZE: (u32, u32) = (960, 560);

/// Width of the legend in pixels.
const LEGEND: u32 = 220;

/// Half the size of a cross in pixels.
const CROSS: i32 = 6;

/// Colours that differ for colour-blind readers too (Okabe & Ito).
pub(super) const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(120, 120, 120),
];

pub(super) const FONT: &str = "sans-serif";

/// The plot as an SVG document.
///
/// # Errors
/// With a sentence, if the drawing library refuses.
pub fn svg(plot: &Plot) -> Result<String, String> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(&area, plot).map_err(|error| format!("{} can't be drawn: {error}", plot.id))?;
    }
    Ok(text)
}

/// The smallest and the largest of the numbers.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, x| match range {
        None => Some((x, x)),
        Some((lo, hi)) => Some((lo.min(x), hi.max(x))),
    })
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

fn draw(area: &Area<'_>, plot: &Plot) -> Drawn {
    area.fill(&WHITE)?;
    let points = || plot.series.iter().flat_map(|series| &series.points);
    let (Some((left, right)), Some((low, high))) =
        (range(points().map(|p| p.0)), range(points().map(|p| p.1)))
    else {
        return Ok(());
    };
    let (area, legend) = area.split_horizontally(SIZE.0 - LEGEND);
    draw_legend(&legend, plot)?;
    let x = left - 0.5..right + 0.5;
    let mut builder = ChartBuilder::on(&area);
    builder
        .caption(&plot.title, (FONT, 22))
        .margin(18)
        .x_label_area_size(48)
        .y_label_area_size(76);
    // The axes' types differ, the steps do not.
    macro_rules! chart {
        ($y:expr, $label:expr) => {{
            let mut chart = builder.build_cartesian_2d(x, $y)?;
            chart
                .configure_mesh()
                .x_desc(plot.x)
                .y_desc(plot.y)
                .x_labels(((right - left) as usize + 2).min(24))
                .x_label_formatter(&|x| match x.fract() == 0.0 {
                    true => format!("{x}"),
                    false => String::new(),
                })
                .y_labels(12)
                .x_max_light_lines(0)
                .y_max_light_lines(if plot.logarithmic { 10 } else { 0 })
                .y_label_formatter(&$label)
                .label_style((FONT, 16))
                .axis_desc_style((FONT, 17))
                .light_line_style(RGBColor(242, 242, 242))
                .bold_line_style(RGBColor(220, 220, 220))
                .draw()?;
            for (series, colour) in plot.series.iter().zip(colours(plot)) {
                let line = colour.stroke_width(2);
                let marks = series.points.iter();
                match series.look {
                    Look::Line => {
                        chart.draw_series(LineSeries::new(series.points.iter().copied(), line))?;
                        chart.draw_series(marks.map(|&p| Circle::new(p, 3, colour.filled())))?;
                    }
                    Look::Crosses => {
                        chart.draw_series(marks.map(|&p| Cross::new(p, CROSS, line)))?;
                    }
                }
            }
        }};
    }
    if plot.logarithmic {
        let whole = |y: &f64| format!("{}", (y * 1e9).round() / 1e9);
        chart!((low * 0.8..high * 1.25).log_scale(), whole);
    } else {
        let pad = 0.08 * (high - low).max(1e-9);
        // No room below 0 where nothing is.
        let bottom = if low < 0.0 {
            low - pad
        } else {
            (low - pad).max(0.0)
        };
        let digits = if high - low < 0.1 { 3 } else { 2 };
        chart!(bottom..high + pad, |y: &f64| format!("{y:.digits$}"));
    }
    Ok(())
}

/// Names beside the plot, where they cover nothing.
fn draw_legend(area: &Area<'_>, plot: &Plot) -> Drawn {
    let font = (FONT, 16).into_font();
    for (i, (series, colour)) in plot.series.iter().zip(colours(plot)).enumerate() {
        let y = 66 + 26 * i as i32;
        let line = colour.stroke_width(2);
        match series.look {
            Look::Line => {
                area.draw(&PathElement::new([(0, y), (28, y)], line))?;
                area.draw(&Circle::new((14, y), 3, colour.filled()))?;
            }
            Look::Crosses => area.draw(&Cross::new((14, y), CROSS, line))?,
        }
        area.draw(&Text::new(series.name.as_str(), (38, y - 8), font.clone()))?;
    }
    Ok(())
}

/// A printed series has the colour of the line that it is named after.
fn colours(plot: &Plot) -> Vec<RGBColor> {
    let lines: Vec<&Series> = plot
        .series
        .iter()
        .filter(|s| s.look == Look::Line)
        .collect();
    let mut extra = lines.len();
    let mut colour = |series: &Series| {
        let own = lines.iter().position(|line| match series.look {
            Look::Line => line.name == series.name,
            Look::Crosses => series.name.strip_suffix(" printed") == Some(&line.name),
        });
        let index = own.unwrap_or_else(|| {
            extra += 1;
            extra - 1
        });
        COLOURS[index % COLOURS.len()]
    };
    plot.series.iter().map(&mut colour).collect()
}
