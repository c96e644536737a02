use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// On how many threads something runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Threads {
    /// One thread, as where many pictures are developed beside each other.
    One,
    /// As many as the process may use.
    All,
}

impl Threads {
    /// One thread, then all.
    pub const EACH: [Self; 2] = [Self::One, Self::All];

    /// As benchmarks are named: `one thread`.
    pub fn name(self) -> &'static str {
        match self {
            Self::One => "one thread",
            Self::All => "all threads",
        }
    }
}

/// A pool of that many threads.
///
/// # Errors
/// If the system gives no threads.
pub fn pool(threads: Threads) -> Result<ThreadPool, ThreadPoolBuildError> {
    let count = match threads {
        Threads::One => 1,
        // What rayon takes for as many as there are.
        Threads::All => 0,
    };
    ThreadPoolBuilder::new().num_threads(count).build()
}
