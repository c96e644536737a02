//! The sentences of the page.

pub(super) const INTRODUCTION: &str = "\
# Held against real film

What is known of real film in numbers, what onelight makes of it, and how far the two lie apart. `cargo xtask fidelity` measures
everything anew and writes this text, and a page with plots to target/onelight; a test holds the text. What nobody measured is not
here: [stocks.md](stocks.md) says of every film what its sheet gives. Unless another is named the look is the default, 5207 on 2383.
";

pub(super) const SLOPES: &str = "\
## Chroma over exposure: Portra 400

How much purer than its light a negative is. Densities of each layer are read back through the film's own grey scale; the slope is that
of the differences between layers over those of their exposures, least squares through 0; 1 is a film whose layers record alone.
Measured: four frames of an IT8.7/2 target on Portra 400 in sunlight of 5400 K (the scans of negicc). Here: the ColorChecker in light
of 5400 K, patches within a grey scale from -1.8 to +0.7 log10 of a grey card. The strength of the inter-image effect was fitted to
those frames and eleven others, so this says how well two numbers describe them, not that they were foreseen.

| stops | slope | measured | here | off | here, on the frames' target | no inter-image effect |
|---|---|---|---|---|---|---|
";

pub(super) const SEPARATIONS: &str = "\
## Separation gamma over neutral gamma

By how much a layer's status M density grows faster at a grey card where its exposure changes alone than where all three do; red,
green, blue.

| film | here | by another program of the same law | no inter-image effect | the same, by the other program |
|---|---|---|---|---|
";

pub(super) const PATENTS: &str = "
Patents, quoted second-hand, give +35..42/+33..45/+20..25 % for a film with inhibitor-releasing couplers (US 5,273,870), +12..15/+12..15/
+8..10 % for the same without them, +10..30/+8..35/+5..15 % (US 4,830,954). A film whose layers develop alone has the wrong sign.
";

pub(super) const DENSITIES: &str = "\
## Densities, gammas, dyes

| what | published or measured | here | off | source |
|---|---|---|---|---|
";

pub(super) const PROVIA: &str = "
The dyes of Provia 100F were held against 288 patches of a measured target on real film outside this program: from its densities
through our dyes to XYZ, dE 0.42 mean, 0.82 at the 95th percentile, 1.80 largest. Other films' dyes in their place: Velvia 0.79,
Ektachrome 1.19, Kodachrome 4.2.
";

pub(super) const CHROMA: &str = "\
## The ColorChecker

Patches 1 to 18 in light of 6500 K, neutral aim: median of the film's chroma over the reflectance's own as a display would show it with
the same mid grey, and hue against it in degrees. Expected: an independent calculation of the same model, and for 5207 with the bare
lamp for white 1.00, at which a film gives colours back as strong as they were.

| film | white | chroma, expected | here | off | light skin | median turn | largest turn |
|---|---|---|---|---|---|---|---|
";

pub(super) const SKIN: &str = "
Held against the reflectance as it is, not as bright as the picture's mid grey of 0.1995, chromas are 1.035 times these. Light skin is
to turn by 12 degrees at most on 5207. Strengths are not changed to meet a figure of this table.
";

pub(super) const REVERSAL: &str = "\
## Which reversal film is stronger

The order of the three in the table above, and what each becomes with one set of figures exchanged for Provia's: median chroma, and the
gamma of a grey card. Each keeps its own grey scale: amounts of the exchanged dyes are those that give it.

| film | as it is | sensitivities | characteristic curves | dyes | cyan dye alone | magenta | yellow | no inter-image effect | gamma | with Provia's curves |
|---|---|---|---|---|---|---|---|---|---|---|
";

pub(super) const WHOSE_STRENGTH: &str = "
The spectral density of the dyes makes the order, and more than half of it the cyan dye alone: at 440 nm Provia's absorbs 0.16 of what
it does at its peak, Ektachrome's and Velvia's 0.06 to 0.07, and no other dye takes that out again. It is the dye that was held against
real film above. Neither sensitivities nor characteristic curves make the order: Ektachrome is the steepest at a grey card, and with Provia's
flatter curves it is no weaker. That photographers know Velvia for the strongest is not in these sheets; the inter-image effect, which
could make it so, is assumed to be the same on all three, for want of a measurement.
";

pub(super) const GREYS: &str = "\
## Greys

b* of greys less that at L* 50. Held against an emulation of 2383 that is widely used in grading; its white is neutral. Bar: 2.5 from
L* 20 up.

| L* | emulation | here | off |
|---|---|---|---|
";

pub(super) const ABSOLUTE: &str = "\
## Greys under `--matching absolute`

Layers are exposed as their published sensitivities say and the film's own axis counts, and grey is not pinned: stops by which an 18 %
grey card lies beside where the balanced film has it, red, green, blue; what becomes of the card in neutral aim, with layers that
inhibit each other and without; the largest C* of greys from -4 to +6 stops. Films whose sheet has a relative axis or names no
criterion of its sensitivities are refused and not here.

| film | off, stops | L* of the card | C* | C*, no inter-image effect | largest C* |
|---|---|---|---|---|---|
";

pub(super) const WHY_ABSOLUTE: &str = "
The scene's light is the 6500 K black body. 5213 and 5219 are balanced for tungsten of 3200 K and see it 2.9 and 3.1 stops bluer than red,
as they do through a lens without an 85 filter. Daylight films are off by 0.1 to 1.2 stops between layers, which is what their axes,
criteria of sensitivity and our reading of them leave. Inter-image effects pull the layers further apart, because the card no longer lies where
their effects cancel: C* rises by a third to nine tenths. Balanced matching, the default, is exact at the card.
";

pub(super) const SURFACE: &str = "\
## The surface of paper

Paper reflects some white light from its surface, of the lamp and of the room. What 0.5 % and 1 % of white paper's light would do, the
paper still being seen as white: L* of the densest black, and CIEDE2000 on the ColorChecker (mean, largest).

| print | black | black, 0.5 % | ColorChecker, 0.5 % | black, 1 % | ColorChecker, 1 % |
|---|---|---|---|---|---|
";

pub(super) const NO_SURFACE: &str = "
None is simulated: a sheet's densities are measured with the surface's reflection kept out, how much there is depends on the room, and no
figure with a source was found; 0.5 to 1 % is assumed. Who wants it adds it to the display-linear picture, as this table does:
(rgb + part) / (1 + part).
";

pub(super) const WAYS: &str = "\
## A negative printed and scanned

The same negative on print film, on paper, and as a scan inverted by the rule of the Cineon system \\[Kennel1995\\]
(`--print scan`: status M densities above the base are the logarithm of light by a gamma of 0.6, the base is black, grey is balanced):
gamma at a grey card, median chroma and turn of the ColorChecker's colours, largest C* of greys from -4 to +2 stops, and stops at which
grey reaches the display's white.

| way | gamma | chroma | turn | tint of greys | white at |
|---|---|---|---|---|---|
";

pub(super) const WHICH_WAY: &str = "
A scan gives the scene's own contrast back (0.97 to 1.18), because the rule takes out what a film of gamma 0.6 put in: it is flat beside
a print, and ends 2.2 to 2.5 stops above grey, where a print still has its shoulder. Scanner programs add curves of their own here;
they are not published. Colours are as strong as on print film, with smaller turns: status M filters see each dye nearly alone. Three
gammas that differ from 0.6 tint its greys above the card.
";

pub(super) const UNCERTAINTY: &str = "\
## What is uncertain

The difference (CIEDE2000) that the stated uncertainties make on the ColorChecker's colours: each set of figures of each layer moved by
what two readings of its sheet differ, near by 0.12 and far by 0.1, one at a time, combined as the root of the sum of squares. `develop
--uncertainty map.exr` draws the same of a picture.

| film | mean | largest | patch | of it sheets, mean | inter-image, mean |
|---|---|---|---|---|---|
";

pub(super) const UNCERTAIN_REVERSAL: &str = "
No measurement says how uncertain the inter-image effect of reversal film is: it is moved by as much as that of negatives.
";

pub(super) const PRINT_CURVES: &str = "\
## How a print film's curves are read

`--print-curves neutral` takes the three curves of 2383 for one grey scale, `principal` for three separations. The emulation has L* 12
two stops below the grey of L* 54, behind a camera film of gamma 0.6: where its negative is thinner by 0.36. Turns in degrees.

| reading | gamma | largest C* of greys | chroma | blue sky | cyan | light skin | L* two stops below | L* where 5207 is thinner by 0.36 | off |
|---|---|---|---|---|---|---|---|---|---|
";

pub(super) const WHICH_READING: &str = "
The readings differ by 3 L* two stops below grey and by little in colour. Counted in stops the emulation lies nearer to principal curves;
counted in density of the negative, which is what a print sees, nearer to neutral ones, since 5207 is flatter below grey than 0.6. That
the emulation's camera film had 0.6 is assumed, so it does not decide. Neutral is the default: it is nearer where the comparison needs
no camera film, and turns fewer colours. A print whose three curves were separations for certain is read with `principal`.
";

pub(super) const TURNS: &str = "\
## Where blue sky turns to cyan

Each row exchanges one thing in the default look; turns of the ColorChecker's blue sky and cyan in degrees, how far that is from the
default, and the median turn of 18 colours. The dichroic printer is the Academy's printer light (SMPTE ST 2065-2) parted at its minima,
490 and 598 nm. Dyes that act alone do so as strongly as on the grey scale, which they leave as it is.

| exchanged | blue sky | change | cyan | change | median turn |
|---|---|---|---|---|---|
";

pub(super) const WHOSE: &str = "
**Blue sky.** The largest share, 12 degrees, is the picture's: three numbers do not say what spectrum they are of, and the smooth one made
of this patch's RGB exposes the layers a little otherwise than the patch itself (a pale blue turns far by little). Spectra of least slope
come as near as the patch, and with negative lobes lie further off elsewhere. The print's dyes make 10 degrees, their unwanted
absorptions as the sheet shows them. Of what is left with the patch's own spectrum, -16, daylight in place of the 6500 K black body
takes 2, the film's white 2. Beams, and print layers that see each other's light, make a degree and less: a printer with dichroic
mirrors would turn it further.

**Cyan.** The inter-image effect turns it by 25 degrees, from +9; it is the strength that was fitted to measured negatives. Dichroic
beams would take 3 degrees. Dyes and layers that act alone turn it further, not back.

Nothing of this is an error of the chain that could be mended without leaving the sheets or the measured strength; who has spectra
develops exposures (`Reference::develop_exposure`) and is rid of the first share.
";

pub(super) const PAGE: &str = "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Held against real film</title><style>
body{font:15px/1.4 sans-serif;max-width:1000px;margin:2em auto}pre{white-space:pre-wrap}svg{width:420px;font-size:11px}
.grid{fill:none;stroke:#ccc}line{stroke:#888}.scene{fill:#fff;stroke:#333}.film{fill:#b33}polyline{fill:none;stroke-width:2}
.title{font-weight:bold}</style>
{body}</html>
";
