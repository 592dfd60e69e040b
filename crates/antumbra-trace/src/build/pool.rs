//! Who builds: the caller's threads, or the calling thread alone.

/// The threads that a build may use. A tree does not depend on their number.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pool<'a> {
    #[cfg(feature = "threads")]
    threads: Option<&'a rayon::ThreadPool>,
    #[cfg(not(feature = "threads"))]
    nobody: std::marker::PhantomData<&'a ()>,
}

#[cfg(feature = "threads")]
impl<'a> From<&'a rayon::ThreadPool> for Pool<'a> {
    fn from(threads: &'a rayon::ThreadPool) -> Pool<'a> {
        Pool { threads: Some(threads) }
    }
}

impl Pool<'_> {
    /// The calling thread alone.
    pub fn serial() -> Pool<'static> {
        Pool::default()
    }

    /// Runs `work` on the pool.
    pub(crate) fn run<R: Send>(&self, work: impl FnOnce(Workers) -> R + Send) -> R {
        #[cfg(feature = "threads")]
        if let Some(threads) = self.threads.filter(|t| t.current_num_threads() > 1) {
            return threads.install(|| work(Workers { many: true }));
        }
        work(Workers { many: false })
    }
}

/// Inside [`Pool::run`]: splits work in two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Workers {
    #[cfg_attr(
        not(feature = "threads"),
        allow(dead_code, reason = "without threads there is nobody to ask")
    )]
    many: bool,
}

impl Workers {
    /// Both results; at the same time where `large` says that it pays and there is someone.
    pub fn join<A: Send, B: Send>(
        self,
        large: bool,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        #[cfg(feature = "threads")]
        if large && self.many {
            return rayon::join(a, b);
        }
        let _ = large;
        (a(), b())
    }

    /// `work(index of first, part)` for consecutive parts of at most `part` elements of `data`.
    pub fn parts<T: Send>(self, data: &mut [T], part: usize, work: &(impl Fn(usize, &mut [T]) + Sync)) {
        self.parts_from(0, data, part, work);
    }

    fn parts_from<T: Send>(
        self,
        first: usize,
        data: &mut [T],
        part: usize,
        work: &(impl Fn(usize, &mut [T]) + Sync),
    ) {
        if data.len() <= part {
            return work(first, data);
        }
        let half = (data.len() / 2).next_multiple_of(part).min(data.len() - 1);
        let (left, right) = data.split_at_mut(half);
        self.join(
            true,
            || self.parts_from(first, left, part, work),
            || self.parts_from(first + half, right, part, work),
        );
    }
}
