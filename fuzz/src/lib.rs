//! What is done with the bytes of each fuzz target, here so that a test over the corpora does the same.
//!
//! Every function takes any bytes. What is refused must be refused in one short sentence; what is read goes on to where a
//! user would take it, and must keep the laws stated there. A broken law panics.

/// `look.toml`, as far as the film at work.
pub mod look;
/// Text files of tables and forms: `.cube`, CLF, `.spi3d`, the JSON of a direct form, and our KTX2 as others read it.
pub mod lut;
/// Pictures: OpenEXR, PNG, TIFF, JPEG, Radiance, whole.
pub mod picture;
/// Data sheets, as far as the film on the screen.
pub mod stock;

/// What became of an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Met {
    /// It was read, and all laws hold.
    Read,
    /// It was refused in a sentence.
    Refused,
}

/// More bytes than any sentence of ours needs.
const SENTENCE_BYTES: usize = 1000;

/// Holds every refusal to the same rule: one plain line of at most [`SENTENCE_BYTES`].
fn refused(error: &impl std::fmt::Display) -> Met {
    let sentence = error.to_string();
    assert!(!sentence.is_empty(), "a refusal without a word");
    assert!(!sentence.contains(char::is_control), "more than one plain line: {sentence:?}");
    assert!(sentence.len() <= SENTENCE_BYTES, "a sentence of {} bytes: {sentence:.100}...", sentence.len());
    Met::Refused
}

/// How often what takes long is done: for one in so many of the inputs that get so far, chosen by their bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OneIn(pub u64);

impl OneIn {
    /// Whether the input is among those.
    fn holds(self, bytes: &[u8]) -> bool {
        // FNV-1a: any hash would do that is the same tomorrow.
        let hash = bytes
            .iter()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3));
        (hash >> 32).is_multiple_of(self.0.max(1))
    }
}

/// Values that arithmetic stumbles over.
const HARD: [f32; 16] = [
    0.0,
    -0.0,
    f32::MIN_POSITIVE / 8.0,
    1e-12,
    0.18,
    0.5,
    1.0,
    1.000_001,
    16.0,
    1e30,
    f32::MAX,
    -1e-6,
    -1.0,
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
];

/// Hard colours: grey, and one channel of three.
fn hard_colours() -> impl Iterator<Item = [f32; 3]> {
    HARD.into_iter().flat_map(|v| [[v; 3], [v, 0.5, 0.25], [0.25, v, 0.5], [0.5, 0.25, v]])
}

/// Makes all work of this process happen on the thread that calls, where libFuzzer counts edges in a fixed order.
pub fn on_one_thread() {
    // It can only be there already.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global();
}
