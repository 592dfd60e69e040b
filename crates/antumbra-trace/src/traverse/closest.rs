//! Closest-hit queries of many lines: made ready eight at a time, walked one after the other, decided eight at a time.

use fearless_simd::Simd;

use super::ask::{Ask, Best, Masks};
use super::boxes::nearest_hit_below;
use super::chunk::Chunk;
use super::eight::Pairs;
use super::ready::{CHUNK, Enters, Lot, Ready};
use super::triangles::{NearestTriangle, offer};
use crate::layout::WIDTH;

/// What lines of a chunk are made ready in.
pub(crate) struct Desk {
    ready: Ready,
    enters: Enters,
}

impl Desk {
    /// No line.
    pub const EMPTY: Desk = Desk { ready: Ready::EMPTY, enters: [[0.0; CHUNK]; WIDTH] };
}

impl<M: Masks> Chunk<'_, M> {
    /// The closest hits by triangles of world space; `bests` come as misses. `alone` answers for lines for which f32 is
    /// not proven.
    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        simd: S,
        desk: &mut Desk,
        bests: &mut [Best; CHUNK],
        alone: impl Fn(&Ask<'_, M>, &mut Best),
    ) {
        let nodes = &self.of.tree.nodes;
        let tree = (self.lines, &self.of.limits, Some(&nodes[0]));
        let [live, wild] = desk.ready.take(simd, tree, (self.from, self.count), Some(&mut desk.enters));
        for i in entries(&wild) {
            alone(&self.ask(i), &mut bests[i]);
        }
        let Desk { ready, enters } = desk;
        let mut pairs = Pairs::NONE;
        for i in entries(&live) {
            let (ray, tmax) = ready.triangle_ray(simd, i);
            let ask = self.ask(i);
            let mut visit = NearestTriangle::<S, M, false>::of_ray(self.of, &ask, ray, &mut bests[i]);
            let meet = |node: &_, tmax| ready.meet_before(simd, node, i, tmax);
            let root = (ready.roots(i) as u32, |child: usize| enters[child % WIDTH][i % CHUNK]);
            nearest_hit_below(simd, nodes, (meet, tmax), root, &mut visit);
            let (left, count) = visit.leave();
            for candidate in left.iter().take(count) {
                if candidate.from > bests[i].limit {
                    continue;
                }
                if pairs.is_full() {
                    self.decide(simd, &mut pairs, bests);
                }
                pairs.add(i, candidate.leaf, candidate.lane);
            }
        }
        self.decide(simd, &mut pairs, bests);
    }

    /// Line `i` of the chunk as a question.
    #[inline(always)]
    fn ask(&self, i: usize) -> Ask<'_, M> {
        Ask::world(self.segments, self.from + i, self.masks)
    }

    /// Asks the law about all `pairs`; then there are none.
    #[inline(never)]
    fn decide<S: Simd>(&self, simd: S, pairs: &mut Pairs, bests: &mut [Best; CHUNK]) {
        simd.vectorize(
            #[inline(always)]
            || {
                let found = pairs.decide(simd, (self.lines, self.from), &self.of.blocks);
                for (k, pair) in pairs.all().enumerate() {
                    let best = &mut bests[pair.line as usize % CHUNK];
                    let (leaf, lane) = (pair.leaf as usize, pair.lane as usize);
                    if found.clear >> k & 1 == 0 {
                        offer(self.of, &self.ask(pair.line as usize), leaf, 1 << lane, best);
                        continue;
                    }
                    let prim = self.of.tree.leaves[leaf][lane];
                    if best.improves(found.t[k], prim) {
                        best.take(found.t[k], prim, found.uv(k));
                    }
                }
            },
        );
        pairs.clear();
    }
}

/// The entries of a lot, in order.
#[inline(always)]
fn entries(lot: &Lot) -> impl Iterator<Item = usize> + use<> {
    let lot = *lot;
    (0..lot.len()).flat_map(move |word| {
        let mut left = lot[word];
        std::iter::from_fn(move || {
            let i = 64 * word + left.trailing_zeros() as usize;
            (left != 0).then(|| {
                left &= left - 1;
                i
            })
        })
    })
}
