use super::content::Content;
use super::element::Element;
use crate::clf::cdl::{Cdl, CdlStyle};
use crate::clf::op::{Beyond, Direction, ExponentStyle, LogCurve, Op, Power, Range, Shape, Toe};
use crate::error::TextProblem;
use onelight_lut::PowerCoding;

pub(super) fn range(start: &Element, contents: &[Content]) -> Result<Op, TextProblem> {
    let mut ends = [[None; 2]; 2];
    for content in contents {
        let Content::Value(element, value) = content else { continue };
        let [low, high] = &mut ends;
        let slot = match element.name() {
            "minInValue" => &mut low[0],
            "minOutValue" => &mut low[1],
            "maxInValue" => &mut high[0],
            _ => &mut high[1],
        };
        if slot.replace(*value).is_some() {
            let [what, expected] = ["values of a Range", "each once"];
            return Err(TextProblem::Unexpected { what, found: format!("{} again", element.name()), expected });
        }
    }
    let [low, high] = ends.map(|[input, output]| match (input, output) {
        (Some(input), Some(output)) => Ok(Some([input, output])),
        (None, None) => Ok(None),
        _ => Err("one of In and Out alone"),
    });
    let beyond = match start.get("style") {
        None | Some("Clamp" | "clamp") => Beyond::Clamp,
        Some("noClamp") => Beyond::Continue,
        Some(_) => return Err(start.bad("style", "Clamp or noClamp")),
    };
    let bad = |found: &str| {
        let expected = "In and Out of an end or of both, each maximum above its minimum, and both ends with noClamp";
        TextProblem::Unexpected { what: "values of a Range", found: found.to_owned(), expected }
    };
    let (low, high) = (low.map_err(bad)?, high.map_err(bad)?);
    match (low, high) {
        (None, None) => return Err(bad("none")),
        (Some([from, at]), Some([to, end])) if !(from < to && at <= end) => return Err(bad("ends in the wrong order")),
        (None, _) | (_, None) if beyond == Beyond::Continue => return Err(bad("one end with noClamp")),
        _ => {}
    }
    Ok(Op::Range(Range { low, high, beyond }))
}

pub(super) fn log(start: &Element, contents: &[Content]) -> Result<Op, TextProblem> {
    let styles = "log2, log10, antiLog2, antiLog10, linToLog, logToLin, cameraLinToLog or cameraLogToLin";
    let (base, direction) = match start.required("style", styles)? {
        "log2" => (Some(2.0), Direction::Forward),
        "log10" => (Some(10.0), Direction::Forward),
        "antiLog2" => (Some(2.0), Direction::Reverse),
        "antiLog10" => (Some(10.0), Direction::Reverse),
        "linToLog" | "cameraLinToLog" => (None, Direction::Forward),
        "logToLin" | "cameraLogToLin" => (None, Direction::Reverse),
        _ => return Err(start.bad("style", styles)),
    };
    let camera = start.get("style").is_some_and(|style| style.starts_with("camera"));
    let channels = match base {
        Some(base) if contents.is_empty() => [LogCurve::of_base(base); 3],
        Some(_) => return Err(unwanted("LogParams")),
        None => per_channel(contents, "LogParams", |element| log_curve(element, camera))?,
    };
    Ok(Op::Log { direction, channels })
}

fn log_curve(element: &Element, camera: bool) -> Result<LogCurve, TextProblem> {
    let number = |name, default| Ok::<_, TextProblem>(element.number(name)?.unwrap_or(default));
    let toe = match (camera, element.number("linSideBreak")?) {
        (false, None) => None,
        (true, Some(end)) => Some(Toe { end, slope: element.number("linearSlope")? }),
        (false, Some(_)) => return Err(element.bad("linSideBreak", "none outside the camera styles")),
        (true, None) => return Err(element.bad("linSideBreak", "a number in the camera styles")),
    };
    let curve = LogCurve {
        base: number("base", 2.0)?,
        log_slope: number("logSideSlope", 1.0)?,
        log_offset: number("logSideOffset", 0.0)?,
        lin_slope: number("linSideSlope", 1.0)?,
        lin_offset: number("linSideOffset", 0.0)?,
        toe,
    };
    if curve.base <= 0.0 || curve.base == 1.0 {
        return Err(element.bad("base", "a number above 0 that is not 1"));
    }
    for (name, slope) in [("logSideSlope", curve.log_slope), ("linSideSlope", curve.lin_slope)] {
        if slope == 0.0 {
            return Err(element.bad(name, "a number that is not 0"));
        }
    }
    match (toe, curve.line()) {
        (Some(toe), Some((_, slope, offset))) => {
            let inside = curve.lin_slope * toe.end + curve.lin_offset;
            let sound = inside > 0.0 && slope != 0.0 && slope.is_finite() && offset.is_finite();
            if sound { Ok(curve) } else { Err(element.bad("linSideBreak", "a place where the curve has a slope")) }
        }
        _ => Ok(curve),
    }
}

pub(super) fn exponent(start: &Element, contents: &[Content]) -> Result<Op, TextProblem> {
    let styles = "basic, basicMirror, basicPassThru, monCurve or monCurveMirror, with Fwd or Rev";
    let style = ExponentStyle::from_word(start.required("style", styles)?).ok_or_else(|| start.bad("style", styles))?;
    let channels = per_channel(contents, "ExponentParams", |element| power(element, style.shape))?;
    Ok(Op::Exponent { style, channels })
}

pub(super) fn cdl(start: &Element, contents: &[Content]) -> Result<Op, TextProblem> {
    let styles = "Fwd, Rev, FwdNoClamp or RevNoClamp";
    let style = match start.get("style") {
        None => CdlStyle::Forward,
        Some(word) => CdlStyle::from_word(word).ok_or_else(|| start.bad("style", styles))?,
    };
    let mut list = Cdl { style, ..Cdl::NEUTRAL };
    let mut seen = Vec::new();
    for (element, values) in contents.iter().flat_map(|content| match content {
        Content::Triples(triples) => triples.as_slice(),
        _ => &[],
    }) {
        let bad = |found: String, expected| TextProblem::Unexpected { what: "values of ASC_CDL", found, expected };
        if seen.contains(&element.name()) {
            return Err(bad(format!("{} again", element.name()), "each once"));
        }
        seen.push(element.name());
        let least = |strict: bool| if strict { "numbers above 0" } else { "numbers that are not below 0" };
        let must = match element.name() {
            "Offset" => {
                list.offset = *values;
                continue;
            }
            "Slope" => {
                list.slope = *values;
                style.is_reverse()
            }
            "Power" => {
                list.power = *values;
                true
            }
            _ => {
                list.saturation = values[0];
                style.is_reverse()
            }
        };
        if values.iter().any(|v| *v < 0.0 || (must && *v <= 0.0)) {
            return Err(bad(format!("{} {values:?}", element.name()), least(must)));
        }
    }
    Ok(Op::Cdl(list))
}

fn power(element: &Element, shape: Shape) -> Result<Power, TextProblem> {
    let expected = match shape {
        Shape::Basic => "a number from 0.01 to 100",
        Shape::MonCurve => "a number from 1 to 10",
    };
    let exponent = element.number("exponent")?.ok_or_else(|| element.bad("exponent", expected))?;
    let offset = element.number("offset")?.unwrap_or(0.0);
    match shape {
        Shape::Basic if offset != 0.0 => Err(element.bad("offset", "none in the basic styles")),
        Shape::Basic if !(0.01..=100.0).contains(&exponent) => Err(element.bad("exponent", expected)),
        Shape::MonCurve if !(1.0..=10.0).contains(&exponent) => Err(element.bad("exponent", expected)),
        Shape::Basic => Ok(Power::Basic(exponent)),
        Shape::MonCurve => PowerCoding::new(exponent, offset)
            .map(Power::MonCurve)
            .map_err(|_| element.bad("offset", "a number from 0 to 0.9, and 0 with an exponent of 1")),
    }
}

/// Parameters for all channels, or one element for each.
fn per_channel<T: Copy>(
    contents: &[Content],
    what: &'static str,
    read: impl Fn(&Element) -> Result<T, TextProblem>,
) -> Result<[T; 3], TextProblem> {
    let mut slots = [None; 3];
    for content in contents {
        let Content::Parameters(element) = content else { continue };
        let channels = match element.get("channel") {
            None => 0..3,
            Some("R") => 0..1,
            Some("G") => 1..2,
            Some("B") => 2..3,
            Some(_) => return Err(element.bad("channel", "R, G or B")),
        };
        let value = read(element)?;
        for slot in slots.iter_mut().skip(channels.start).take(channels.len()) {
            if slot.replace(value).is_some() {
                return Err(unwanted(what));
            }
        }
    }
    match slots {
        [Some(r), Some(g), Some(b)] => Ok([r, g, b]),
        _ => {
            let expected = "one element for all channels or one for each";
            Err(TextProblem::Unexpected { what, found: "a channel without".to_owned(), expected })
        }
    }
}

fn unwanted(what: &'static str) -> TextProblem {
    TextProblem::Unexpected {
        what,
        found: "one more".to_owned(),
        expected: "one element for all channels or one for each, and none for a bare logarithm",
    }
}
