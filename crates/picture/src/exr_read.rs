//! Reading OpenEXR: the header and its checks; the pixels are read by [`exr_bands`](crate::exr_bands).
//!
//! The `exr` crate parses the header and unpacks blocks. The table of offsets and the blocks' own headers are read
//! here, so that each block is known to be the one asked for: a damaged table then gives an error and not a picture
//! with a hole.

use std::io::{Seek, SeekFrom};

use exr::{
    compression::Compression,
    math::Vec2,
    meta::{
        BlockDescription, MetaData,
        attribute::{AttributeValue, IntegerBounds},
        header::Header,
    },
};

use crate::{
    band::Bands,
    description::{Channels, Chromaticities, Description, Source, StoredAlpha, Tristimulus, Windows},
    error::{Error, ExrProblem, exr_message},
    exr_bands::{self, ExrBands},
    exr_blocks::Blocks,
    exr_boxes,
    exr_layout::{self, Colours},
    exr_luminance_chroma::{self, LuminanceChromaBands},
    file_colours::{FileColours, of_interop_id},
    input::Input,
    limits::{Limits, check_claim, check_shown},
    panic_to_error::panic_to_error,
    selection::Selection,
};

/// Opens a picture in an OpenEXR file of `length` bytes.
pub(crate) fn open<'a>(
    mut reader: Input<'a>,
    length: u64,
    limits: &Limits,
    selection: &Selection,
) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    exr_boxes::check(&mut reader)?;
    reader.seek(SeekFrom::Start(0))?;
    let meta = panic_to_error(|| MetaData::read_from_buffered(&mut reader, false))?
        .map_err(|error| ExrProblem::HeaderUnreadable(exr_message(&error)))?;
    let tables_at = reader.stream_position()?;

    let layout = exr_layout::choose(&meta.headers, selection)?;
    let header = &meta.headers[layout.part];
    check(header, length, limits)?;
    // The crate knows no subsampled channels: these are checked here.
    let mut checked = header.clone();
    if let Colours::LuminanceChroma { step } = layout.colours {
        exr_luminance_chroma::check(header, &layout, step, limits)?;
        checked.channels.list.iter_mut().for_each(|channel| channel.sampling = Vec2(1, 1));
    }
    panic_to_error(|| MetaData::validate(std::slice::from_ref(&checked), false))?
        .map_err(|error| ExrProblem::HeaderWrong(exr_message(&error)))?;

    let (windows, mut notes) = (windows(header), layout.notes.clone());
    if windows.pixel_aspect != header.shared_attributes.pixel_aspect {
        notes.push("took the pixels for square, as the file's pixel aspect ratio cannot be".to_owned());
    }
    let white_luminance = header.own_attributes.white_luminance.filter(|found| found.is_finite() && *found > 0.0);
    if let Some(found) = white_luminance {
        notes.push(format!(
            "the file says that (1, 1, 1) is {found} cd/m2, which changes nothing: exposure is relative"
        ));
    }
    let mut description = Description {
        width: header.layer_size.0,
        height: header.layer_size.1,
        channels: if layout.alpha.is_some() { Channels::Rgba } else { Channels::Rgb },
        stored_alpha: StoredAlpha::Premultiplied,
        windows,
        white_luminance,
        notes,
        ..Description::new(1, 1, Channels::Rgb, Source::Exr)
    };
    let is_xyz = layout.colours == Colours::Xyz;
    colours(header, is_xyz).describe(&mut description);
    if is_xyz {
        description.tristimulus = Tristimulus::Xyz;
    }
    reader.seek(SeekFrom::Start(0))?;
    description.metadata.exr = exr_boxes::metadata(&mut reader, layout.part);
    let blocks = Blocks::open(reader, length, tables_at, &meta, layout.part)?;
    let bands: Box<dyn Bands + 'a> = match layout.colours {
        Colours::LuminanceChroma { step } => {
            Box::new(LuminanceChromaBands::new(blocks, meta, layout, step, description.primaries.as_ref()))
        }
        Colours::Rgb | Colours::Xyz => Box::new(ExrBands::new(blocks, meta, layout)),
    };
    Ok((description, bands))
}

/// Checks all that memory is taken for, before it is taken.
fn check(header: &Header, length: u64, limits: &Limits) -> Result<(), Error> {
    let (width, height) = (header.layer_size.0 as u64, header.layer_size.1 as u64);
    limits.check_size("the data window", width, height)?;
    let IntegerBounds { size, .. } = header.shared_attributes.display_window;
    let shown = [size.0 as u64, size.1 as u64];
    limits.check_size("the display window", shown[0], shown[1])?;
    check_shown([width, height], shown)?;
    if let BlockDescription::Tiles(tiles) = header.blocks {
        let tile = tiles.tile_size;
        if tile.0 as u64 > limits.max_side || tile.1 as u64 > limits.max_side {
            return Err(ExrProblem::TileSide { found: [tile.0, tile.1], max: limits.max_side }.into());
        }
    }
    let expansion = expansion(header.compression)?;
    let bytes = header.channels.list.iter().map(|channel| {
        let Vec2(across, down) = channel.subsampled_resolution(header.layer_size);
        (across as u64 * down as u64).saturating_mul(channel.sample_type.bytes_per_sample() as u64)
    });
    let claimed = bytes.fold(0, u64::saturating_add);
    check_claim([width, height], claimed, length, expansion)?;
    exr_bands::check_memory(header, limits)
}

/// The most bytes of samples that one byte of file can stand for, generously: zlib gives 1032, PXR24 a third more, the
/// runs of PIZ some 400; DWA stores one coefficient for 64 flat pixels on top of that.
fn expansion(compression: Compression) -> Result<u64, Error> {
    match compression {
        Compression::Uncompressed => Ok(1),
        Compression::RLE => Ok(64),
        Compression::ZIP1
        | Compression::ZIP16
        | Compression::PIZ
        | Compression::PXR24
        | Compression::B44
        | Compression::B44A => Ok(1 << 11),
        Compression::DWAA(_) | Compression::DWAB(_) => Ok(1 << 15),
        Compression::HTJ2K32 | Compression::HTJ2K256 => {
            Err(ExrProblem::Compression { found: "HTJ2K".to_owned() }.into())
        }
    }
}

/// What the header says of the colours: by the channels' names, by chromaticities, by the interchange name.
fn colours(header: &Header, is_xyz: bool) -> FileColours {
    let chromaticities = header.shared_attributes.chromaticities.map(|xy| Chromaticities {
        red: [xy.red.0, xy.red.1],
        green: [xy.green.0, xy.green.1],
        blue: [xy.blue.0, xy.blue.1],
        white: [xy.white.0, xy.white.1],
    });
    let others = || header.own_attributes.other.iter().chain(&header.shared_attributes.other);
    let named = others().find_map(|(name, value)| match value {
        AttributeValue::Text(text) if name.eq("colorInteropID") => of_interop_id(&text.to_string()),
        _ => None,
    });
    let transfer = named.as_ref().map(|(_, transfer)| transfer.clone());
    if is_xyz {
        let said_by = "the names of its channels".to_owned();
        return FileColours { primaries: Some(Chromaticities::XYZ), transfer, said_by };
    }
    match (chromaticities, named) {
        (Some(primaries), _) => {
            FileColours { primaries: Some(primaries), transfer, said_by: "its chromaticities".to_owned() }
        }
        (None, Some((primaries, _))) => {
            FileColours { primaries: Some(primaries), transfer, said_by: "its colorInteropID".to_owned() }
        }
        (None, None) => FileColours::default(),
    }
}

fn windows(header: &Header) -> Windows {
    let data = header.own_attributes.layer_position;
    let display = header.shared_attributes.display_window;
    let aspect = header.shared_attributes.pixel_aspect;
    Windows {
        data_origin: [data.0, data.1],
        display_origin: [display.position.0, display.position.1],
        display_size: [display.size.0, display.size.1],
        // The range of OpenEXR's own check, without which the picture could not be written again.
        pixel_aspect: if (1e-6..=1e6).contains(&aspect) { aspect } else { 1.0 },
    }
}
