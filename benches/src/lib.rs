//! Benchmarks of the onelight crates; `cargo bench` runs them.
