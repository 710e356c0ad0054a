//! Drawings to scale, as SVG.

use plotters::prelude::*;

use super::plots::{COLOURS, FONT};
use crate::paper::Picture;

/// Width in pixels, and the margin round the drawing.
const WIDTH: u32 = 960;
const MARGIN: f64 = 60.0;
/// Height of a line of the legend.
const LEGEND: i32 = 26;

/// The picture as an SVG document: both axes have the same scale.
///
/// # Errors
/// With a sentence, if the drawing library refuses.
pub fn svg(picture: &Picture) -> Result<String, String> {
    let mut text = String::new();
    draw(&mut text, picture).map_err(|error| format!("{} can't be drawn: {error}", picture.id))?;
    Ok(text)
}

fn draw(text: &mut String, picture: &Picture) -> Result<(), Box<dyn std::error::Error>> {
    let mut names: Vec<&str> = Vec::new();
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for line in &picture.lines {
        if !names.contains(&line.name) {
            names.push(line.name);
        }
        for &(x, y) in &line.points {
            (low, high) = (
                [low[0].min(x), low[1].min(y)],
                [high[0].max(x), high[1].max(y)],
            );
        }
    }
    let size = [0, 1].map(|i| (high[i] - low[i]).max(1e-9));
    let scale = (f64::from(WIDTH) - 2.0 * MARGIN) / size[0];
    let top = 44 + LEGEND * names.len() as i32;
    let height = f64::from(top) + size[1] * scale + MARGIN;
    let area = SVGBackend::with_string(text, (WIDTH, height as u32)).into_drawing_area();
    area.fill(&WHITE)?;
    area.draw(&Text::new(
        picture.title.as_str(),
        (MARGIN as i32, 14),
        (FONT, 22).into_font(),
    ))?;
    let colour = |name: &str| {
        let index = names.iter().position(|n| *n == name).unwrap_or(0);
        COLOURS[index % COLOURS.len()]
    };
    for (i, name) in names.iter().enumerate() {
        let y = 52 + LEGEND * i as i32;
        let x = MARGIN as i32;
        area.draw(&PathElement::new(
            [(x, y), (x + 28, y)],
            colour(name).stroke_width(3),
        ))?;
        area.draw(&Text::new(*name, (x + 38, y - 8), (FONT, 16).into_font()))?;
    }
    // What comes last is drawn last, and thicker.
    for line in &picture.lines {
        let place = |&(x, y): &(f64, f64)| {
            let across = MARGIN + (x - low[0]) * scale;
            let down = f64::from(top) + (high[1] - y) * scale;
            (across.round() as i32, down.round() as i32)
        };
        let points: Vec<(i32, i32)> = line.points.iter().map(place).collect();
        let width = if line.name == names[names.len() - 1] {
            4
        } else {
            1
        };
        area.draw(&PathElement::new(
            points,
            colour(line.name).stroke_width(width),
        ))?;
    }
    area.present()?;
    Ok(())
}
