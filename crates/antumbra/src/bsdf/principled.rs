//! Disney's principled model as Mitsuba 3 has it (Burley 2012 and 2015): a diffuse base with sheen, facets of metal or of a
//! boundary that reflects and lets light through, and a clear coat.
//!
//! f = f_diff + f_sheen + f_coat + f_facets, each from the front; from the back only what the facets of glass do.
//! m metallic, t spec_trans, F_d Fresnel's equations, S(c) = (1−c)⁵, c_d = ω_o·h, tint = base/luminance:
//! f_diff = (1−m)(1−t) base/π · lerp(lambertian and retroreflection, Hanrahan and Krueger's subsurface, flatness),
//! f_sheen = (1−m) sheen · lerp(1, tint, sheen_tint) · S(c_d),
//! f_coat = ¼ clearcoat · (0.04 + 0.96 S(c_d)) · D_c(h) G_c(ω_o) G_c(ω_i), D_c with Burley's longest tails,
//! f_facets = F D G₁G₁ / (4 μ_o μ_i), F = (1−m)((1−s) F_d + s Schlick(R₀ tint)) + m Schlick(base), s spec_tint; below the
//! surface (1−m) t √base (1−F_d) times the refraction of `rough_boundary.rs`.
//! The parts are added, not weighed against each other: a white base, or sheen, gives back more than it gets, most at grazing
//! angles, as in Mitsuba. (`metallic_roughness.rs` never does.)

use antumbra_math::{Local, Rgb, real, warp};

use super::facets::Facets;
use super::rough_boundary::{Joined, RoughBoundary};
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// What the clear coat reflects straight on.
const COAT_F0: f32 = 0.04;
/// α of the clear coat's masking.
const COAT_SHADE: f32 = 0.25;

/// The numbers of Disney's model, each in [0, 1] but `eta`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principled {
    /// Base colour.
    pub base: Rgb,
    /// 0 = dielectric, 1 = metal.
    pub metallic: f32,
    /// Perceptual roughness: α = roughness².
    pub roughness: f32,
    /// How much wider the facets reflect along the first tangent than along the second.
    pub anisotropic: f32,
    /// n below the surface over n above it, in [0.1, 10].
    pub eta: f32,
    /// Share of what is not metal that lets light through.
    pub spec_trans: f32,
    /// How far what the dielectric reflects takes the tint of the base.
    pub spec_tint: f32,
    /// Light that cloth gives off at grazing angles.
    pub sheen: f32,
    /// How far it takes the tint of the base.
    pub sheen_tint: f32,
    /// Strength of a second, clear and narrow lobe.
    pub clearcoat: f32,
    /// 1 = narrow, 0 = wide.
    pub clearcoat_gloss: f32,
    /// From a rough diffuse base, 0, to one that light wanders through, 1.
    pub flatness: f32,
    /// +z is its back.
    pub turned: bool,
}

impl Default for Principled {
    /// Mitsuba's: grey 0.5, η 1.5, roughness 0.5, the rest 0.
    fn default() -> Principled {
        Principled {
            base: Rgb::grey(0.5),
            metallic: 0.0,
            roughness: 0.5,
            anisotropic: 0.0,
            eta: 1.5,
            spec_trans: 0.0,
            spec_tint: 0.0,
            sheen: 0.0,
            sheen_tint: 0.0,
            clearcoat: 0.0,
            clearcoat_gloss: 0.0,
            flatness: 0.0,
            turned: false,
        }
    }
}

/// Probabilities of the lobes that `sample` draws from; the facets have the rest.
struct Lobes {
    diffuse: f32,
    coat: f32,
}

impl Principled {
    /// The same surface seen from its other side.
    pub fn turned(self) -> Principled {
        Principled { turned: !self.turned, ..self }
    }

    /// Every number that lies in [0, 1].
    pub(crate) fn shares(&mut self) -> [&mut f32; 10] {
        [
            &mut self.metallic,
            &mut self.roughness,
            &mut self.anisotropic,
            &mut self.spec_trans,
            &mut self.spec_tint,
            &mut self.sheen,
            &mut self.sheen_tint,
            &mut self.clearcoat,
            &mut self.clearcoat_gloss,
            &mut self.flatness,
        ]
    }

    /// (1−m)(1−t).
    #[inline]
    fn diffuse_weight(&self) -> f32 {
        (1.0 - self.metallic) * (1.0 - self.spec_trans)
    }

    /// (1−m) t.
    #[inline]
    fn glass_weight(&self) -> f32 {
        (1.0 - self.metallic) * self.spec_trans
    }

    #[inline]
    fn is_front(&self, w: Local) -> bool {
        (w.cos() > 0.0) != self.turned
    }

    /// α_x α_y = roughness⁴, α_y/α_x = 1 − 0.9 anisotropic.
    #[inline]
    pub fn facets(&self) -> Facets {
        let aspect = (1.0 - 0.9 * self.anisotropic).sqrt();
        let alpha = self.roughness * self.roughness;
        Facets::new(alpha / aspect, alpha * aspect)
    }

    #[inline]
    fn boundary(&self) -> RoughBoundary {
        let boundary = RoughBoundary::new(self.eta, self.facets());
        if self.turned { boundary.turned() } else { boundary }
    }

    /// The base colour at luminance 1.
    #[inline]
    fn tint(&self) -> Rgb {
        let luminance = self.base.luminance();
        if luminance > 0.0 { self.base / luminance } else { Rgb::WHITE }
    }

    /// F of the front's facets; `fresnel` is F_d at the cosine.
    #[inline]
    fn reflected(&self, cos: f32, fresnel: f32) -> Rgb {
        let dielectric = (1.0 - self.metallic) * (1.0 - self.spec_tint) * fresnel;
        // From the denser side Schlick's rise follows the refracted direction.
        let cos = if self.eta >= 1.0 { cos } else { fresnel::dielectric(cos, self.eta).cos_beyond };
        let schlick = |straight: Rgb| straight.lerp(Rgb::WHITE, rise(cos));
        let straight = (self.eta - 1.0) / (self.eta + 1.0);
        let tinted = schlick(self.tint() * (straight * straight)) * ((1.0 - self.metallic) * self.spec_tint);
        Rgb::grey(dielectric) + schlick(self.base) * self.metallic + tinted
    }

    /// f_diff and f_sheen; `c` = ω_o·h.
    #[inline]
    fn diffuse(&self, mu_o: f32, mu_i: f32, c: f32) -> Rgb {
        let (fo, fi) = (rise(mu_o), rise(mu_i));
        let retro = 2.0 * self.roughness * c * c;
        let rough = (1.0 - 0.5 * fo) * (1.0 - 0.5 * fi) + retro * (fo + fi + fo * fi * (retro - 1.0));
        let grazing = 0.5 * retro - 1.0;
        let below = (1.0 + grazing * fo) * (1.0 + grazing * fi);
        let flat = 1.25 * (below * (1.0 / (mu_o + mu_i).max(f32::MIN_POSITIVE) - 0.5) + 0.5);
        let shape = rough + (flat - rough) * self.flatness;
        let sheen = Rgb::WHITE.lerp(self.tint(), self.sheen_tint) * ((1.0 - self.metallic) * self.sheen);
        self.base * (self.diffuse_weight() * real::INV_PI * shape) + sheen * rise(c)
    }

    /// α of the coat: 0.1 wide to 0.001 narrow.
    #[inline]
    pub fn coat_alpha(&self) -> f32 {
        0.1 + (0.001 - 0.1) * self.clearcoat_gloss
    }

    /// D_c = (α²−1) / (π ln α² (sin² + α² cos²)) of the half vector.
    #[inline]
    fn coat_d(&self, wo: Local, wi: Local) -> f32 {
        let (v, a2) = (wo.0 + wi.0, self.coat_alpha() * self.coat_alpha());
        let across = v.x * v.x + v.y * v.y;
        let square = (across + v.z * v.z).max(f32::MIN_POSITIVE);
        (a2 - 1.0) * real::INV_PI * square
            / (real::logf(a2) * (across + a2 * v.z * v.z).max(f32::MIN_POSITIVE))
    }

    /// f_coat; `c` = ω_o·h.
    #[inline]
    fn coat(&self, wo: Local, wi: Local, c: f32) -> f32 {
        if self.clearcoat <= 0.0 {
            return 0.0;
        }
        let shade = |w: Local| Facets::isotropic(COAT_SHADE).seen(w) * w.cos().abs();
        let fresnel = COAT_F0 + (1.0 - COAT_F0) * rise(c);
        0.25 * self.clearcoat * fresnel * self.coat_d(wo, wi) * shade(wo) * shade(wi)
    }

    /// p(ω_i) of the coat: D_c(h) cos θ_h / (4 ω_o·h).
    #[inline]
    fn coat_density(&self, wo: Local, wi: Local) -> f32 {
        let v = wo.0 + wi.0;
        // cos θ_h / ω_o·h = 2 v_z / |v|².
        0.5 * self.coat_d(wo, wi) * v.z.abs() / v.length_squared().max(f32::MIN_POSITIVE)
    }

    /// ω_o mirrored about a normal of p(h) = D_c cos θ_h: cos² θ_h = (1 − α^(2(1−u))) / (1 − α²).
    #[inline]
    fn coat_sample(&self, wo: Local, u: [f32; 2]) -> Local {
        let a2 = self.coat_alpha() * self.coat_alpha();
        let cos2 = ((1.0 - real::powf(a2, 1.0 - u[0])) / (1.0 - a2)).clamp(0.0, 1.0);
        let (sin, phi) = ((1.0 - cos2).sqrt(), 2.0 * real::PI * u[1]);
        let m = Local::new(sin * real::cosf(phi), sin * real::sinf(phi), cos2.sqrt() * wo.cos().signum()).0;
        Local((m * (2.0 * wo.0.dot(m)) - wo.0).normalize())
    }

    /// About what each lobe reflects of light from ω_o, as probabilities.
    #[inline]
    fn lobes(&self, wo: Local) -> Lobes {
        if !self.is_front(wo) {
            return Lobes { diffuse: 0.0, coat: 0.0 };
        }
        let mu = wo.cos().abs();
        let fresnel = fresnel::dielectric(mu.min(1.0), self.eta).reflected;
        let facets = self.reflected(mu, fresnel).mean() + self.let_through(fresnel).mean();
        let diffuse = self.diffuse_weight() * self.base.mean() + 0.1 * (1.0 - self.metallic) * self.sheen;
        let coat = self.clearcoat * (COAT_F0 + (1.0 - COAT_F0) * rise(mu)) * (0.25 + 0.75 * mu);
        let all = (facets + diffuse + coat).max(f32::MIN_POSITIVE);
        Lobes { diffuse: diffuse / all, coat: coat / all }
    }

    /// What facets that reflect `fresnel` let through.
    #[inline]
    fn let_through(&self, fresnel: f32) -> Rgb {
        self.base.map(f32::sqrt) * (self.glass_weight() * (1.0 - fresnel))
    }

    /// The share of a facet's light that it reflects; `fresnel` is F_d at the cosine.
    #[inline]
    fn reflecting(&self, front: bool, cos: f32, fresnel: f32) -> f32 {
        let reflected =
            if front { self.reflected(cos, fresnel).mean() } else { self.glass_weight() * fresnel };
        let through = self.let_through(fresnel).mean();
        if through > 0.0 { reflected / (reflected + through) } else { 1.0 }
    }

    /// f_facets.
    #[inline]
    fn faceted(&self, boundary: &RoughBoundary, wo: Local, wi: Local, j: &Joined) -> Rgb {
        let f = boundary.spread(wo, wi, j) * boundary.facets.seen(wi);
        if !wo.same_side(wi) {
            self.let_through(j.fresnel) * f
        } else if self.is_front(wo) {
            self.reflected(j.om.abs().min(1.0), j.fresnel) * f
        } else {
            Rgb::grey(self.glass_weight() * j.fresnel * f)
        }
    }

    /// p(ω_i) of all lobes together.
    #[inline]
    fn density(&self, boundary: &RoughBoundary, wo: Local, wi: Local, j: &Joined) -> f32 {
        let (front, reflects) = (self.is_front(wo), wo.same_side(wi));
        let share = self.reflecting(front, j.om.abs().min(1.0), j.fresnel);
        let share = if reflects { share } else { 1.0 - share };
        let Lobes { diffuse, coat } = self.lobes(wo);
        let facets = (1.0 - diffuse - coat).max(0.0) * share * boundary.density(wo, wi, j);
        if !(front && reflects) {
            return facets;
        }
        let coat = if coat > 0.0 { coat * self.coat_density(wo, wi) } else { 0.0 };
        facets + diffuse * wi.cos().abs() * real::INV_PI + coat
    }

    /// f_r and p(ω_i); `None` where no facet joins the two.
    #[inline]
    fn both(&self, wo: Local, wi: Local) -> Option<(Rgb, f32)> {
        let dark = self.glass_weight() <= 0.0 && !(self.is_front(wo) && self.is_front(wi));
        let boundary = self.boundary();
        let j = boundary.joined(wo, wi).filter(|_| !dark)?;
        let mut f = self.faceted(&boundary, wo, wi, &j);
        if self.is_front(wo) && wo.same_side(wi) {
            let c = j.om.abs().min(1.0);
            f += self.diffuse(wo.cos().abs(), wi.cos().abs(), c) + Rgb::grey(self.coat(wo, wi, c));
        }
        Some((f, self.density(&boundary, wo, wi, &j)))
    }
}

/// S(c) = (1−c)⁵, Schlick's rise.
#[inline]
fn rise(cos: f32) -> f32 {
    let miss = (1.0 - cos).clamp(0.0, 1.0);
    let miss2 = miss * miss;
    miss2 * miss2 * miss
}

impl BsdfKind for Principled {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        self.both(wo, wi).map_or(Rgb::BLACK, |(f, _)| f)
    }

    /// One of the lobes by about what it reflects; of the facets a visible one, which reflects or refracts.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() == 0.0 {
            return None;
        }
        let front = self.is_front(wo);
        let Lobes { diffuse, coat } = self.lobes(wo);
        let wi = if u[2] < diffuse {
            Local(warp::cosine_hemisphere([u[0], u[1]]).0 * wo.cos().signum())
        } else if u[2] < diffuse + coat {
            self.coat_sample(wo, [u[0], u[1]])
        } else {
            let boundary = self.boundary();
            let seen = boundary.sample(wo, [u[0], u[1]]);
            let left = ((u[2] - diffuse - coat) / (1.0 - diffuse - coat)).min(1.0);
            let cos = seen.cos.clamp(0.0, 1.0);
            boundary.sent(wo, &seen, left < self.reflecting(front, cos, seen.boundary.reflected))?
        };
        let (f, pdf) = self.both(wo, wi)?;
        let throughput = f * (wi.cos().abs() / pdf);
        (pdf > 0.0).then_some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        self.both(wo, wi).map_or(0.0, |(_, pdf)| pdf)
    }

    #[inline]
    fn index_below(&self) -> Option<f32> {
        (self.glass_weight() > 0.0).then(|| self.boundary().eta)
    }

    /// Each part's mean over all pairs of directions, by fits to within 0.03; the coat's hundredth is left out.
    fn albedo(&self) -> Rgb {
        let eta = self.boundary().eta;
        let fresnel = fresnel::average_of(eta, |mu| fresnel::dielectric(mu, eta).reflected);
        let [ax, ay] = self.facets().alpha();
        let kept = 1.0 / (1.0 + 0.83 * (ax * ax + ay * ay));
        // The mean of (1−μ)⁵ over directions of equal light is 1/21.
        let metal = self.base.lerp(Rgb::WHITE, 1.0 / 21.0) * self.metallic;
        let reflected = Rgb::grey((1.0 - self.metallic) * fresnel) + metal;
        let rough = 0.953 + 0.112 * self.roughness;
        let shape = rough + (0.939 + 0.046 * self.roughness - rough) * self.flatness;
        let diffuse = self.base * (self.diffuse_weight() * shape);
        let sheen =
            Rgb::WHITE.lerp(self.tint(), self.sheen_tint) * ((1.0 - self.metallic) * self.sheen * 0.0116);
        (reflected + self.let_through(fresnel)) * kept + diffuse + sheen
    }

    fn examples() -> Vec<Principled> {
        let plain = Principled::default();
        let red = Rgb([0.7, 0.3, 0.1]);
        vec![
            plain,
            Principled { base: red, metallic: 0.4, anisotropic: 0.8, ..plain },
            Principled { base: red, spec_trans: 0.6, spec_tint: 0.5, roughness: 0.4, ..plain },
            Principled { base: red, spec_trans: 1.0, eta: 1.33, roughness: 0.3, ..plain }.turned(),
            Principled { base: red, clearcoat: 1.0, clearcoat_gloss: 0.5, roughness: 0.7, ..plain },
            Principled { sheen: 0.2, sheen_tint: 0.5, flatness: 0.7, ..plain },
        ]
    }
}
