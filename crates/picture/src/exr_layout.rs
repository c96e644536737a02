//! Which channels of an OpenEXR file are the picture.

use exr::meta::{
    attribute::{ChannelDescription, SampleType},
    header::Header,
};

use crate::{
    decoder_message::one_line,
    error::{Error, ExrProblem},
};

/// Most channel names that a message lists.
const NAMES_LISTED: usize = 24;
/// Most bytes of those names together, so that the message stays one that can be read.
const NAME_BYTES_LISTED: usize = 600;

/// The part and the channels to read.
#[derive(Debug)]
pub(crate) struct Layout {
    /// Which of the file's parts this is, from 0.
    pub(crate) part: usize,
    /// The channels red, green and blue; the same thrice for a grey picture.
    pub(crate) rgb: [Plane; 3],
    /// The channel of coverage (alpha), if the part has one.
    pub(crate) alpha: Option<Plane>,
    /// What was chosen among several.
    pub(crate) notes: Vec<String>,
}

/// One channel within the interleaved rows of its part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plane {
    /// Bytes a pixel takes in the channels before this one.
    pub(crate) bytes_before: usize,
    /// How a sample is stored.
    pub(crate) samples: SampleType,
}

/// Chooses the first flat part with R, G and B (without a layer name if it can be, else the first layer that has all
/// three), and if there is none the first with a luminance channel Y.
pub(crate) fn choose(parts: &[Header]) -> Result<Layout, Error> {
    let flat = || parts.iter().enumerate().filter(|(_, part)| !part.deep);
    let coloured = flat().find_map(|(index, part)| Some((index, find(part, Set::Rgb)?)));
    let found = coloured.or_else(|| flat().find_map(|(index, part)| Some((index, find(part, Set::Grey)?))));
    let Some((index, group)) = found else {
        if parts.iter().any(|part| part.deep) {
            return Err(ExrProblem::DeepData.into());
        }
        return Err(ExrProblem::Channels { found: names(parts) }.into());
    };
    let part = &parts[index];
    if let Some(channel) = part.channels.list.iter().find(|channel| channel.sampling.0 != 1 || channel.sampling.1 != 1)
    {
        let step = [channel.sampling.0, channel.sampling.1];
        return Err(ExrProblem::Subsampled { channel: one_line(&channel.name.to_string()), step }.into());
    }

    let mut notes = Vec::new();
    if parts.len() > 1 {
        let name = part
            .own_attributes
            .layer_name
            .as_ref()
            .map_or(String::new(), |name| format!(" (`{}`)", one_line(&name.to_string())));
        notes.push(format!("read part {}{name} of {} parts", index + 1, parts.len()));
    }
    if !group.layer.is_empty() {
        notes.push(format!(
            "read the layer `{}`, as there are no channels without a layer name that make a picture",
            one_line(&group.layer)
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
    let mut bytes = 0;
    let short = |name: &String| {
        bytes += name.len();
        bytes <= NAME_BYTES_LISTED
    };
    let listed: Vec<String> =
        all().take(NAMES_LISTED).map(|channel| one_line(&channel.name.to_string())).take_while(short).collect();
    let more = all().count() - listed.len();
    match (listed.is_empty(), more) {
        (true, 0) => "(none)".to_owned(),
        (true, more) => format!("({more} of long names)"),
        (false, 0) => listed.join(", "),
        (false, more) => format!("{} and {more} more", listed.join(", ")),
    }
}
