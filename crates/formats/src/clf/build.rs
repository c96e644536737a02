use super::ClfProcess;
use super::coupling;
use super::op::{Direction, ExponentStyle, LogCurve, Op, Power, Range};
use crate::error::{Error, ErrorKind};
use onelight_lut::{
    Decode, Domain, IDENTITY, Interpolation, LOG_FLOOR, Lut1d, Lut3d, Mix, NegativeLight, PlainLut, PowerCoding, Rows,
    ShaperKind, StructuredLut,
};

/// The brightest light that a file's ranges let through.
///
/// OpenColorIO writes bounds into the text of its shaders and puts a point after those that have none, so one of 1e17 or more
/// becomes `1e+17.`, which no compiler of shaders takes. Film is black or clear 40 stops below this, and powers of ten up to
/// 1e22 are exact.
const RANGE_MAX: f64 = 1e16;

impl ClfProcess {
    /// A structured LUT with its matrices and curves, so that nothing is needed beside the file.
    ///
    /// A chain of three channels holds two steps only nearly. Coupled layers become a table of 33^3 log exposures before the curves
    /// (0.05 dE on a film). Light below 0 that is compressed goes through the matrices uncut, which is the same for little of it,
    /// and ends at the floor of the logarithm.
    ///
    /// # Errors
    ///
    /// None that a [`StructuredLut`] can cause today; the tables are checked once more.
    pub fn from_structured(lut: &StructuredLut) -> Result<Self, Error> {
        let parts = lut.parts();
        let max = RANGE_MAX;
        let mut ops = Vec::new();
        if parts.expose.input != IDENTITY {
            ops.push(Op::Range(Range::clamp(-max, max)));
            ops.push(matrix(&parts.expose.input));
        }
        ops.push(match parts.expose.negative {
            NegativeLight::Clip => Op::Range(Range::clamp(0.0, max)),
            NegativeLight::Compress => Op::Range(Range::clamp(-max, max)),
        });
        ops.push(matrix(&parts.expose.matrix));
        ops.push(Op::Range(Range::floor(f64::from(LOG_FLOOR))));
        match &parts.develop.coupling {
            None => ops.push(log_to_unit(parts.develop.curves.domain())),
            Some(coupling) => {
                let unit = coupling::unit(&parts.develop, coupling)?;
                ops.push(log_to_unit(&unit));
                ops.extend(coupling::ops(&parts.develop, coupling, &unit)?);
            }
        }
        ops.push(over_unit(&parts.develop.curves)?);
        if let Some(mix) = &parts.mix {
            ops.push(mix_to_unit(mix));
            ops.push(over_unit(&mix.curves)?);
        }
        ops.push(Op::Lut3d(parts.table.clone(), parts.interpolation));
        if let Decode::Density { matrix: rows, coding } = &parts.decode {
            ops.push(matrix(&[[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]));
            ops.push(Op::Log { direction: Direction::Reverse, channels: [LogCurve::of_base(10.0); 3] });
            ops.push(matrix(rows));
            ops.extend(exponent(coding));
        }
        Ok(Self::with_ops(ops))
    }

    /// A plain LUT: a range, the shaper as a logarithm, the table.
    ///
    /// # Errors
    ///
    /// If the shaper is no [`ShaperKind::Log2Offset`], which is the only one today.
    pub fn from_plain(lut: &PlainLut) -> Result<Self, Error> {
        let ShaperKind::Log2Offset { offset, max } = lut.shaper().kind() else {
            return Err(ErrorKind::Shaper { found: lut.shaper().kind() }.into());
        };
        let curve = LogCurve {
            log_slope: 1.0 / (1.0 + max / offset).log2(),
            lin_slope: 1.0 / offset,
            lin_offset: 1.0,
            ..LogCurve::of_base(2.0)
        };
        Ok(Self::with_ops(vec![
            Op::Range(Range::clamp(0.0, max)),
            Op::Log { direction: Direction::Forward, channels: [curve; 3] },
            Op::Lut3d(lut.table().clone(), lut.interpolation()),
        ]))
    }

    /// A table alone, for colours that are coded already.
    pub fn from_table(table: &Lut3d, interpolation: Interpolation) -> Self {
        Self::with_ops(vec![Op::Lut3d(table.clone(), interpolation)])
    }
}

fn matrix(rows: &Rows) -> Op {
    Op::Matrix { rows: rows.map(|row| row.map(f64::from)), offset: [0.0; 3] }
}

/// Ends of a domain, channel by channel.
fn ends(domain: &Domain) -> [[f64; 2]; 3] {
    let [min, max] = [domain.min(), domain.max()];
    std::array::from_fn(|i| [f64::from(min[i]), f64::from(max[i])])
}

/// The logarithm of base 2, with `domain` moved onto 0 to 1.
fn log_to_unit(domain: &Domain) -> Op {
    let channels = ends(domain).map(|[min, max]| {
        let span = max - min;
        LogCurve { log_slope: 1.0 / span, log_offset: -min / span, ..LogCurve::of_base(2.0) }
    });
    Op::Log { direction: Direction::Forward, channels }
}

/// The mix, with the domain of its curves moved onto 0 to 1.
fn mix_to_unit(mix: &Mix) -> Op {
    let ends = ends(mix.curves.domain());
    Op::Matrix {
        rows: std::array::from_fn(|i| mix.matrix[i].map(|v| f64::from(v) / (ends[i][1] - ends[i][0]))),
        offset: std::array::from_fn(|i| (f64::from(mix.offset[i]) - ends[i][0]) / (ends[i][1] - ends[i][0])),
    }
}

fn over_unit(curves: &Lut1d) -> Result<Op, Error> {
    Ok(Op::Lut1d(Lut1d::new(Domain::UNIT, curves.entries().to_vec())?))
}

/// The output's coding; none for linear light.
fn exponent(coding: &PowerCoding) -> Option<Op> {
    if *coding == PowerCoding::LINEAR {
        return None;
    }
    let (style, power) = if coding.offset() == 0.0 {
        (ExponentStyle::BASIC_MIRROR_REV, Power::Basic(coding.exponent()))
    } else {
        (ExponentStyle::MON_CURVE_MIRROR_REV, Power::MonCurve(*coding))
    };
    Some(Op::Exponent { style, channels: [power; 3] })
}
