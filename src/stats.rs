//! Counts of what was done and what was skipped; nothing where nobody asks.

/// Something worth counting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// A ray from the camera.
    PrimaryRay,
    /// A mirrored ray.
    ReflectedRay,
    /// A refracted ray, or one that goes straight through.
    RefractedRay,
    /// A search for what stands between a point and a light.
    ShadowRay,
    /// A light that could not contribute, so that no shadow ray was sent.
    ShadowSkip,
    /// A ray against a leaf.
    LeafTest,
    /// An object that was skipped by its bounds.
    BoundsSkip,
    /// A secondary ray that the greatest depth cut.
    DepthCut,
    /// A secondary ray below the least weight.
    WeightCut,
    /// A secondary ray that the error budget paid for.
    BudgetCut,
    /// A texture that was evaluated.
    Texture,
}

impl Event {
    /// All events in the order of [`Stats::counts`].
    pub const ALL: [Self; 11] = [
        Self::PrimaryRay,
        Self::ReflectedRay,
        Self::RefractedRay,
        Self::ShadowRay,
        Self::ShadowSkip,
        Self::LeafTest,
        Self::BoundsSkip,
        Self::DepthCut,
        Self::WeightCut,
        Self::BudgetCut,
        Self::Texture,
    ];

    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::PrimaryRay => "primary_rays",
            Self::ReflectedRay => "reflected_rays",
            Self::RefractedRay => "refracted_rays",
            Self::ShadowRay => "shadow_rays",
            Self::ShadowSkip => "shadow_skips",
            Self::LeafTest => "leaf_tests",
            Self::BoundsSkip => "bounds_skips",
            Self::DepthCut => "depth_cuts",
            Self::WeightCut => "weight_cuts",
            Self::BudgetCut => "budget_cuts",
            Self::Texture => "textures",
        }
    }
}

/// Who hears of events. The unit type does not listen, and costs nothing.
pub trait Tally {
    /// Takes note of one.
    fn count(&mut self, event: Event);

    /// Takes note of something that the rays of a sample met, and those of its neighbour may not have:
    /// a face of a leaf, a cell of a texture, a light that is not hidden, or nothing at all. The mark is
    /// different for different things. Nobody has to listen, and then it is not worked out.
    #[inline]
    fn meet(&mut self, mark: impl FnOnce() -> u32 + Copy) {
        let _ = mark;
    }
}

impl Tally for () {
    #[inline]
    fn count(&mut self, _: Event) {}
}

/// A counter for each event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// How often each event happened, in the order of [`Event::ALL`].
    pub counts: [u64; Event::ALL.len()],
}

impl Stats {
    /// How often an event happened.
    pub fn of(&self, event: Event) -> u64 {
        self.counts.get(event as usize).copied().unwrap_or(0)
    }

    /// All rays: from the camera, mirrored, refracted, and to lights.
    pub fn rays(&self) -> u64 {
        let kinds = [Event::PrimaryRay, Event::ReflectedRay, Event::RefractedRay, Event::ShadowRay];
        kinds.iter().map(|event| self.of(*event)).sum()
    }

    /// Adds what another counted.
    pub fn add(&mut self, other: &Self) {
        for (mine, theirs) in self.counts.iter_mut().zip(other.counts) {
            *mine += theirs;
        }
    }
}

impl Tally for Stats {
    #[inline]
    fn count(&mut self, event: Event) {
        if let Some(count) = self.counts.get_mut(event as usize) {
            *count += 1;
        }
    }
}
