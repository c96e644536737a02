//! Which channels of an OpenEXR file are the picture.

use std::collections::{BTreeMap, BTreeSet};

use exr::meta::{
    attribute::{ChannelDescription, SampleType},
    header::Header,
};

use crate::{
    decoder_message::one_line,
    error::{Error, ExrProblem},
    selection::{PartChoice, Selection},
};

/// Most names that a message lists.
const NAMES_LISTED: usize = 24;
/// Most bytes of those names together, so that the message stays one that can be read.
const NAME_BYTES_LISTED: usize = 600;

/// Layers that are the finished picture wherever they are, the likeliest first: Blender's, Arnold's and Nuke's, V-Ray's,
/// RenderMan's, Octane's.
const BEAUTY: [&str; 5] = ["combined", "beauty", "rgba", "C", "color"];
/// What layers hold that are not a picture, or a part of its light alone. A word of three letters and more counts within
/// others, as `DiffCol` and `CryptoObject00` have it.
const NOT_A_PICTURE: [&str; 24] = [
    "albedo",
    "ao",
    "cryp",
    "depth",
    "diff",
    "emit",
    "env",
    "gloss",
    "id",
    "index",
    "light",
    "mask",
    "mist",
    "motion",
    "n",
    "normal",
    "occlusion",
    "p",
    "position",
    "shadow",
    "spec",
    "trans",
    "uv",
    "vector",
];

/// The part and the channels to read.
#[derive(Debug)]
pub(crate) struct Layout {
    /// Which of the file's parts this is, from 0.
    pub(crate) part: usize,
    /// The channels red, green and blue, or X, Y and Z, or RY, Y and BY; the same thrice for a grey picture.
    pub(crate) rgb: [Plane; 3],
    /// The channel of coverage (alpha), if the part has one.
    pub(crate) alpha: Option<Plane>,
    /// What the three channels are.
    pub(crate) colours: Colours,
    /// What was chosen among several.
    pub(crate) notes: Vec<String>,
}

/// What the three channels of a picture are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Colours {
    Rgb,
    /// The CIE's X, Y and Z.
    Xyz,
    /// RY, Y and BY, the first and the last for every `step`th pixel across and down: 1 or 2.
    LuminanceChroma {
        step: usize,
    },
}

/// One channel within the interleaved rows of its part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plane {
    /// Its place among the channels of the part.
    pub(crate) index: usize,
    /// Bytes a pixel takes in the channels before this one.
    pub(crate) bytes_before: usize,
    /// How a sample is stored.
    pub(crate) samples: SampleType,
}

/// Chooses the likeliest picture of a file, among what `selection` leaves: colour before grey, no layer name before one that
/// says beauty before any other, earlier parts before later ones.
pub(crate) fn choose(parts: &[Header], selection: &Selection) -> Result<Layout, Error> {
    let wanted_part = wanted_part(parts, selection)?;
    let flat = || parts.iter().enumerate().filter(|(_, part)| !part.deep);
    let all: Vec<Group> = flat().flat_map(|(index, part)| groups(index, part, parts.len() > 1)).collect();
    let named = selection.layer.is_some() || wanted_part.is_some();
    let is_wanted = |group: &&Group| {
        wanted_part.is_none_or(|part| group.part == part)
            && selection.layer.as_ref().is_none_or(|layer| group.is_called(layer))
            && (named || !group.is_not_a_picture())
    };
    let Some(group) = all.iter().filter(is_wanted).min_by_key(|group| group.rank()) else {
        return Err(nothing_found(parts, &all, selection));
    };
    let part = &parts[group.part];
    let colours = match group.set {
        Set::LuminanceChroma => Colours::LuminanceChroma { step: chroma_step(part, group.rgb) },
        Set::Xyz => Colours::Xyz,
        Set::Rgb | Set::Grey | Set::Lone => Colours::Rgb,
    };
    for (index, channel) in part.channels.list.iter().enumerate() {
        let is_chroma = matches!(colours, Colours::LuminanceChroma { .. })
            && (index == group.rgb[0].index || index == group.rgb[2].index);
        let expected = match colours {
            Colours::LuminanceChroma { step } if is_chroma => step,
            _ => 1,
        };
        let step = [channel.sampling.0, channel.sampling.1];
        if step != [expected; 2] {
            return Err(ExrProblem::Subsampled { channel: one_line(&channel.name.to_string()), step }.into());
        }
    }

    let mut notes = Vec::new();
    let others = all.iter().filter(|other| (other.part, &other.layer) != (group.part, &group.layer));
    let others = names_of(others);
    let others = if others.is_empty() { String::new() } else { format!("; there are also {}", listed(&others)) };
    let in_part = (parts.len() > 1).then(|| {
        let name = part_name(part).map_or(String::new(), |name| format!(" (`{}`)", one_line(&name)));
        format!("part {}{name} of {} parts", group.part + 1, parts.len())
    });
    match (in_part, &group.layer[..]) {
        (None, "") if others.is_empty() => {}
        (None, "") => notes.push(format!("read the channels without a layer name{others}")),
        (None, layer) => notes.push(format!("read the layer `{}`{others}", one_line(layer))),
        (Some(part), "") => notes.push(format!("read {part}{others}")),
        (Some(part), layer) => notes.push(format!("read the layer `{}` of {part}{others}", one_line(layer))),
    }
    match group.set {
        Set::Rgb => {}
        Set::Xyz => notes.push("took the channels X, Y and Z for the light's CIE XYZ".to_owned()),
        Set::LuminanceChroma => {
            notes.push("made red, green and blue of luminance and chroma (Y, RY and BY)".to_owned());
        }
        Set::Grey => notes.push("read the luminance channel Y as grey".to_owned()),
        Set::Lone => notes.push(format!("read the only channel, `{}`, as grey", one_line(&group.channel))),
    }
    let Group { part, rgb, alpha, .. } = *group;
    Ok(Layout { part, rgb, alpha, colours, notes })
}

/// How many pixels share a difference: 2 where it is kept for a quarter of them, else 1.
fn chroma_step(part: &Header, [red, ..]: [Plane; 3]) -> usize {
    let sampling = part.channels.list.get(red.index).map(|channel| channel.sampling);
    sampling.map_or(1, |sampling| sampling.0.clamp(1, 2))
}

/// The part that is asked for, from 0.
fn wanted_part(parts: &[Header], selection: &Selection) -> Result<Option<usize>, Error> {
    let found = match &selection.part {
        None => return Ok(None),
        Some(PartChoice::Number(number)) => number.checked_sub(1).filter(|index| *index < parts.len()),
        Some(PartChoice::Name(name)) => {
            parts.iter().position(|part| part_name(part).is_some_and(|own| own.eq_ignore_ascii_case(name)))
        }
    };
    let asked = || selection.part.as_ref().map(ToString::to_string).unwrap_or_default();
    let names = || {
        let named = |(index, part): (usize, &Header)| match part_name(part) {
            Some(name) => format!("{} (`{}`)", index + 1, one_line(&name)),
            None => (index + 1).to_string(),
        };
        listed(&parts.iter().enumerate().map(named).collect::<Vec<_>>())
    };
    found.map(Some).ok_or_else(|| ExrProblem::NoPart { asked: one_line(&asked()), found: names() }.into())
}

/// Why there is no picture.
fn nothing_found(parts: &[Header], all: &[Group], selection: &Selection) -> Error {
    let layers = names_of(all.iter());
    if let Some(layer) = &selection.layer {
        let found = if layers.is_empty() { "no layer".to_owned() } else { listed(&layers) };
        return ExrProblem::NoLayer { asked: one_line(layer), found }.into();
    }
    if parts.iter().any(|part| part.deep) {
        return ExrProblem::DeepData.into();
    }
    let channels: Vec<String> = parts.iter().flat_map(|part| &part.channels.list).map(|c| c.name.to_string()).collect();
    if layers.is_empty() {
        let short: Vec<String> = channels.iter().map(|name| one_line(name)).collect();
        return ExrProblem::Channels { found: listed(&short) }.into();
    }
    ExrProblem::NoBeauty { found: listed(&layers) }.into()
}

fn part_name(part: &Header) -> Option<String> {
    part.own_attributes.layer_name.as_ref().map(ToString::to_string)
}

/// What channels make a picture, the likeliest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Set {
    Rgb,
    Xyz,
    LuminanceChroma,
    Grey,
    Lone,
}

/// The channels of one layer that make a picture.
#[derive(Debug, Clone)]
struct Group {
    part: usize,
    /// The name of the part, where there are several.
    part_name: Option<String>,
    layer: String,
    set: Set,
    rgb: [Plane; 3],
    /// The name of the first channel.
    channel: String,
    alpha: Option<Plane>,
}

/// The names of red, green and blue that programs write, in any case of letters.
const RED_GREEN_BLUE: [[&str; 3]; 2] = [["r", "g", "b"], ["red", "green", "blue"]];

/// What may be a picture in a part: of each layer the likeliest channels.
fn groups(index: usize, part: &Header, several: bool) -> Vec<Group> {
    let mut bytes_before = 0;
    let channels: Vec<Channel> = part
        .channels
        .list
        .iter()
        .enumerate()
        .map(|(index, described)| {
            let channel = Channel::new(described, index, bytes_before);
            bytes_before += described.sample_type.bytes_per_sample();
            channel
        })
        .collect();
    // Those without a layer name come first, the others in the order of the file.
    let mut layers: Vec<(&str, Vec<&Channel>)> = vec![("", Vec::new())];
    let mut places = BTreeMap::from([("", 0)]);
    for channel in &channels {
        let place = *places.entry(channel.layer.as_str()).or_insert(layers.len());
        if place == layers.len() {
            layers.push((&channel.layer, Vec::new()));
        }
        layers[place].1.push(channel);
    }
    let coloured = channels.iter().filter(|channel| !channel.is("a") && !channel.is("alpha")).count();
    let group = |(layer, own): (&str, Vec<&Channel>)| {
        let find = |name: &str| own.iter().copied().find(|channel| channel.is(name));
        let exactly = |name: &str| own.iter().copied().find(|channel| channel.name == name);
        let three = |names: [&str; 3]| Some([find(names[0])?, find(names[1])?, find(names[2])?]);
        let coordinates = || Some([exactly("X")?, exactly("Y")?, exactly("Z")?]);
        let chroma = || Some([exactly("RY")?, exactly("Y")?, exactly("BY")?]);
        let luminance = || exactly("Y").filter(|_| exactly("RY").is_none() && exactly("BY").is_none());
        let (set, found) = if let Some(found) = RED_GREEN_BLUE.into_iter().find_map(three) {
            (Set::Rgb, found)
        } else if let Some(found) = coordinates() {
            // With a layer name they are directions and places: a normal, a position.
            if !layer.is_empty() {
                return None;
            }
            (Set::Xyz, found)
        } else if let Some(found) = chroma() {
            (Set::LuminanceChroma, found)
        } else if let Some(found) = luminance() {
            (Set::Grey, [found; 3])
        } else if coloured == 1 {
            (Set::Lone, [own.iter().copied().find(|channel| !channel.is("a") && !channel.is("alpha"))?; 3])
        } else {
            return None;
        };
        Some(Group {
            part: index,
            part_name: part_name(part).filter(|_| several),
            layer: layer.to_owned(),
            set,
            rgb: found.map(|channel| channel.plane),
            channel: found[0].name.clone(),
            alpha: find("a").or_else(|| find("alpha")).map(|channel| channel.plane),
        })
    };
    layers.into_iter().filter_map(group).collect()
}

impl Group {
    /// The words of its part's and its layer's name.
    fn words(&self) -> impl Iterator<Item = &str> {
        let names = [self.part_name.as_deref().unwrap_or_default(), &self.layer];
        names.into_iter().flat_map(|name| name.split(|c: char| !c.is_alphanumeric())).filter(|word| !word.is_empty())
    }

    fn beauty(&self) -> Option<usize> {
        // A single letter has many meanings, of which only the capital is this one.
        let is = |word: &str, beauty: &str| word == beauty || (beauty.len() > 1 && word.eq_ignore_ascii_case(beauty));
        BEAUTY.iter().position(|beauty| self.words().any(|word| is(word, beauty)))
    }

    /// Whether its name says that it is something else than the finished picture.
    fn is_not_a_picture(&self) -> bool {
        let is = |word: &str, not: &str| word == not || (not.len() > 2 && word.contains(not));
        let words = || self.words().map(str::to_lowercase);
        self.beauty().is_none() && words().any(|word| NOT_A_PICTURE.iter().any(|not| is(&word, not)))
    }

    /// Smallest for the likeliest picture. Colour comes before grey.
    fn rank(&self) -> (bool, usize, Set, usize) {
        let nameless = self.layer.is_empty() && self.part_name.is_none();
        let name = if nameless { 0 } else { self.beauty().map_or(BEAUTY.len() + 1, |place| place + 1) };
        (self.set >= Set::Grey, name, self.set, self.part)
    }

    /// Whether a user may mean it by `name`: its layer, the last word of that, or its part.
    fn is_called(&self, name: &str) -> bool {
        let last = self.layer.rsplit('.').next().unwrap_or_default();
        let part = self.part_name.as_deref().filter(|_| self.layer.is_empty());
        [Some(self.layer.as_str()), Some(last), part].into_iter().flatten().any(|own| own.eq_ignore_ascii_case(name))
    }

    /// Its name for a message.
    fn shown(&self) -> String {
        match (&self.part_name, &self.layer[..]) {
            (None, "") => "channels without a layer name".to_owned(),
            (None, layer) => format!("`{}`", one_line(layer)),
            (Some(part), "") => format!("`{}`", one_line(part)),
            (Some(part), layer) if layer.starts_with(part.as_str()) => format!("`{}`", one_line(layer)),
            (Some(part), layer) => format!("`{}` in part `{}`", one_line(layer), one_line(part)),
        }
    }
}

/// A channel with its name taken apart.
struct Channel {
    layer: String,
    name: String,
    plane: Plane,
}

impl Channel {
    fn new(described: &ChannelDescription, index: usize, bytes_before: usize) -> Self {
        let full = described.name.to_string();
        let (layer, name) = full.rsplit_once('.').unwrap_or(("", &full));
        Self {
            layer: layer.to_owned(),
            name: name.to_owned(),
            plane: Plane { index, bytes_before, samples: described.sample_type },
        }
    }

    /// Whether that is its name, whatever the case of letters.
    fn is(&self, name: &str) -> bool {
        self.name.eq_ignore_ascii_case(name)
    }
}

/// The names of groups, each once.
fn names_of<'a>(groups: impl Iterator<Item = &'a Group>) -> Vec<String> {
    let mut seen = BTreeSet::new();
    groups.map(Group::shown).filter(|name| seen.insert(name.clone())).collect()
}

/// Names in one line, the first of many.
fn listed(names: &[String]) -> String {
    let mut bytes = 0;
    let short = |name: &&String| {
        bytes += name.len();
        bytes <= NAME_BYTES_LISTED
    };
    let listed: Vec<&str> = names.iter().take(NAMES_LISTED).take_while(short).map(String::as_str).collect();
    let more = names.len() - listed.len();
    match (listed.is_empty(), more) {
        (true, 0) => "(none)".to_owned(),
        (true, more) => format!("({more} of long names)"),
        (false, 0) => listed.join(", "),
        (false, more) => format!("{} and {more} more", listed.join(", ")),
    }
}
