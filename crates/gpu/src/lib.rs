//! The film on the GPU, inside the user's own frame.
//!
//! Nothing is here yet: this crate reserves the place of the wgpu application of the forms in `onelight-lut`, so that the
//! layers above it need not move when it comes. It has no items and no dependencies.
