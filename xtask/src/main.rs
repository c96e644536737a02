//! The onelight runner.

fn main() {}
