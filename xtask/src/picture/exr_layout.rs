//! Which channels of an OpenEXR file are the picture.

use anyhow::{Result, bail};
use exr::meta::{
    attribute::{ChannelDescription, SampleType},
    header::Header,
};

use super::guard::told;

/// Most channel names that a message lists.
const NAMES_LISTED: usize = 24;

/// The part and the channels to read.
#[derive(Debug)]
pub(super) struct Layout {
    /// Index of the part.
    pub(super) part: usize,
    /// The channels red, green and blue; the same thrice for a grey picture.
    pub(super) rgb: [Plane; 3],
    /// The channel of coverage.
    pub(super) alpha: Option<Plane>,
    /// What was chosen among several.
    pub(super) notes: Vec<String>,
}

/// One channel within the interleaved rows of its part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    /// Bytes a pixel takes in the channels before this one.
    pub(super) bytes_before: usize,
    /// How a sample is stored.
    pub(super) samples: SampleType,
}

/// Chooses the first flat part with R, G and B (without a layer name if it can be, else the first layer that has all
/// three), and if there is none the first with a luminance channel Y.
pub(super) fn choose(parts: &[Header]) -> Result<Layout> {
    let flat = || parts.iter().enumerate().filter(|(_, part)| !part.deep);
    let coloured = flat().find_map(|(index, part)| Some((index, find(part, Set::Rgb)?)));
    let found = coloured.or_else(|| flat().find_map(|(index, part)| Some((index, find(part, Set::Grey)?))));
    let Some((index, group)) = found else {
        if parts.iter().any(|part| part.deep) {
            bail!("the file holds deep data, expected a flat picture (flatten it first)");
        }
        bail!("found the channels {}, expected R, G and B (or Y)", names(parts));
    };
    let part = &parts[index];
    if let Some(channel) = part.channels.list.iter().find(|channel| channel.sampling.0 != 1 || channel.sampling.1 != 1)
    {
        bail!(
            "the channel `{}` is subsampled {} x {}, expected a sample of every channel at every pixel",
            told(&channel.name.to_string()),
            channel.sampling.0,
            channel.sampling.1
        );
    }

    let mut notes = Vec::new();
    if parts.len() > 1 {
        let name = part
            .own_attributes
            .layer_name
            .as_ref()
            .map_or(String::new(), |name| format!(" (`{}`)", told(&name.to_string())));
        notes.push(format!("read part {}{name} of {} parts", index + 1, parts.len()));
    }
    if !group.layer.is_empty() {
        notes.push(format!(
            "read the layer `{}`, as there are no channels without a layer name that make a picture",
            told(&group.layer)
        ));
    }
    if group.set == Set::Grey {
        notes.push("read the luminance channel Y as grey".to_owned());
    }
    Ok(Layout { part: index, rgb: group.rgb, alpha: group.alpha, notes })
}

/// What channels make a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Set {
    Rgb,
    Grey,
}

/// The channels of one layer that make a picture.
struct Group {
    layer: String,
    set: Set,
    rgb: [Plane; 3],
    alpha: Option<Plane>,
}

/// The first layer of `part` that has the `set`, the one without a name before all others.
fn find(part: &Header, set: Set) -> Option<Group> {
    let mut bytes_before = 0;
    let channels: Vec<Channel> = part
        .channels
        .list
        .iter()
        .map(|described| {
            let channel = Channel::new(described, bytes_before);
            bytes_before += described.sample_type.bytes_per_sample();
            channel
        })
        .collect();
    let layers = std::iter::once("").chain(channels.iter().map(|channel| channel.layer.as_str()));
    layers.into_iter().find_map(|layer| {
        let plane = |name: &str| {
            let mut own = channels.iter().filter(|channel| channel.layer == layer);
            own.find(|channel| channel.name == name).map(|channel| channel.plane)
        };
        let rgb = match set {
            Set::Rgb => [plane("R")?, plane("G")?, plane("B")?],
            // Luminance with chroma is colour in another form, not grey.
            Set::Grey if plane("RY").is_some() || plane("BY").is_some() => return None,
            Set::Grey => [plane("Y")?; 3],
        };
        Some(Group { layer: layer.to_owned(), set, rgb, alpha: plane("A") })
    })
}

/// A channel with its name taken apart.
struct Channel {
    layer: String,
    name: String,
    plane: Plane,
}

impl Channel {
    fn new(described: &ChannelDescription, bytes_before: usize) -> Self {
        let full = described.name.to_string();
        let (layer, name) = full.rsplit_once('.').unwrap_or(("", &full));
        Self {
            layer: layer.to_owned(),
            name: name.to_owned(),
            plane: Plane { bytes_before, samples: described.sample_type },
        }
    }
}

fn names(parts: &[Header]) -> String {
    let all = || parts.iter().flat_map(|part| &part.channels.list);
    let listed: Vec<String> = all().take(NAMES_LISTED).map(|channel| told(&channel.name.to_string())).collect();
    let more = all().count().saturating_sub(NAMES_LISTED);
    match (listed.is_empty(), more) {
        (true, _) => "(none)".to_owned(),
        (false, 0) => listed.join(", "),
        (false, more) => format!("{} and {more} more", listed.join(", ")),
    }
}
