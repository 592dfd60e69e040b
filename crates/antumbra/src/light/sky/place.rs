//! Where the sun stands, from a place and a time.
//!
//! The sun's mean elements, equation of the centre, aberration, nutation and sidereal time are those of Meeus,
//! Astronomical Algorithms (1998), chapters 12, 22 and 25; the largest pulls of Venus, Jupiter and the moon are those of
//! Meeus, Astronomical Formulae for Calculators (1988), chapter 18. Refraction: Sæmundsson's formula as in Meeus,
//! chapter 16.

use antumbra_math::real::{asin, atan2, cos, sin, tan};

/// The air that bends the light of a low sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Pressure [hPa]; 0: no refraction.
    pub pressure: f64,
    /// Temperature [°C].
    pub temperature: f64,
}

impl Default for Air {
    /// Near sea level: 1010 hPa, 10 °C.
    fn default() -> Air {
        Air { pressure: 1010.0, temperature: 10.0 }
    }
}

/// Where the sun stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunPosition {
    /// Above the horizon, refraction included [rad].
    pub elevation: f64,
    /// Clockwise from north over east, in [0, 2π) [rad].
    pub azimuth: f64,
    /// Distance [astronomical units].
    pub distance: f64,
}

/// ΔT = TT − UT [s] of our years. It is 64 s in 2000 and about 75 s in 2050; the sun moves 0.0007° in a minute of it.
const DELTA_T: f64 = 69.0;

/// Where the sun stands at `unix` seconds since 1970-01-01T00:00Z, seen from `latitude` (north positive) and `longitude`
/// (east positive) [rad]. Without refraction within 0.006° (0.002° root mean square) of an ephemeris at 3,000 random places
/// and times from 1969 to 2024.
pub fn sun_position(unix: f64, latitude: f64, longitude: f64, air: Air) -> SunPosition {
    let days = unix / 86_400.0 + 2_440_587.5 - 2_451_545.0;
    let t = (days + DELTA_T / 86_400.0) / 36_525.0;
    let (lambda, distance) = longitude_and_distance(t);
    let node = radians(125.04 - 1934.136 * t);
    let nutation =
        radians(-0.004_78) * sin(node) - radians(0.000_366) * sin(2.0 * radians(280.4665 + 36_000.769_8 * t));
    let obliquity = radians(23.439_291_1 - 0.013_004_2 * t) + radians(0.002_56) * cos(node);
    let lambda = lambda + nutation;
    let right_ascension = atan2(cos(obliquity) * sin(lambda), cos(lambda));
    let declination = asin(sin(obliquity) * sin(lambda));
    let turned = 280.460_618_37 + 360.985_647_366_29 * days + 0.000_387_933 * t * t;
    let sidereal = radians(turned % 360.0) + nutation * cos(obliquity);
    let hour = sidereal + longitude - right_ascension;
    let up = sin(latitude) * sin(declination) + cos(latitude) * cos(declination) * cos(hour);
    let south = cos(hour) * sin(latitude) * cos(declination) - sin(declination) * cos(latitude);
    let west = sin(hour) * cos(declination);
    let azimuth = (atan2(west, south) + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
    // The observer stands on the earth, not in its middle: 8.794″ at the horizon.
    let level = (west * west + south * south).sqrt();
    let elevation = atan2(up, level) - radians(8.794 / 3600.0) / distance * level;
    SunPosition { elevation: elevation + refraction(elevation, air), azimuth, distance }
}

/// The sun's true longitude with aberration, for the mean equinox of the date [rad], and its distance [au]; `t` in
/// centuries of 36,525 days of TT since J2000.
fn longitude_and_distance(t: f64) -> (f64, f64) {
    let mean = 280.466_46 + t * (36_000.769_83 + t * 0.000_303_2);
    let anomaly = radians((357.529_11 + t * (35_999.050_29 - t * 0.000_153_7)) % 360.0);
    let e = 0.016_708_634 - t * (0.000_042_037 + t * 0.000_000_126_7);
    let centre = sin(anomaly) * (1.914_602 - t * (0.004_817 + t * 0.000_014))
        + sin(2.0 * anomaly) * (0.019_993 - t * 0.000_101)
        + sin(3.0 * anomaly) * 0.000_289;
    let distance = 1.000_001_018 * (1.0 - e * e) / (1.0 + e * cos(anomaly + radians(centre)));
    let longitude = mean + centre + pulls(t + 1.0) - 0.005_69;
    (radians(longitude % 360.0), distance)
}

/// What Venus, Jupiter and the moon add to the sun's longitude [°]; `t` in centuries since 1900.
fn pulls(t: f64) -> f64 {
    let angle = |start: f64, rate: f64| radians((start + rate * t) % 360.0);
    0.001_34 * cos(angle(153.23, 22_518.754_1))
        + 0.001_54 * cos(angle(216.57, 45_037.508_2))
        + 0.002_00 * cos(angle(312.69, 32_964.357_7))
        + 0.001_79 * sin(angle(350.74, 445_267.114_2))
        + 0.001_78 * sin(angle(231.19, 20.20))
}

/// How much higher the light of a true elevation seems to come from [rad]; none for a sun that has set.
fn refraction(elevation: f64, air: Air) -> f64 {
    let degrees = elevation.to_degrees();
    if degrees < -1.0 {
        return 0.0;
    }
    let minutes = 1.02 / tan(radians(degrees + 10.3 / (degrees + 5.11)));
    radians(minutes / 60.0) * (air.pressure / 1010.0) * (283.0 / (273.0 + air.temperature))
}

fn radians(degrees: f64) -> f64 {
    degrees.to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The worked example of Reda and Andreas, Solar Position Algorithm for Solar Radiation Applications, NREL
    /// TP-560-34302 (2008), appendix A.5: 2003-10-17, 12:30:30 at UTC − 7 h, 39.742476° north, 105.1786° west, 820 hPa,
    /// 11 °C: zenith 50.11162°, azimuth 194.34024°, distance 0.996 542 297 4 au.
    #[test]
    fn the_worked_example_of_nrel() {
        let unix = 1_066_419_030.0;
        let air = Air { pressure: 820.0, temperature: 11.0 };
        let sun = sun_position(unix, radians(39.742_476), radians(-105.1786), air);
        let (zenith, azimuth) = (90.0 - sun.elevation.to_degrees(), sun.azimuth.to_degrees());
        assert!((zenith - 50.111_62).abs() < 0.002, "zenith {zenith}");
        assert!((azimuth - 194.340_24).abs() < 0.002, "azimuth {azimuth}");
        assert!((sun.distance - 0.996_542_3).abs() < 1e-4, "distance {}", sun.distance);
    }

    /// At the solstices the sun culminates at 90° − latitude ± 23.44°; at the pole it circles level.
    #[test]
    fn solstices_and_the_pole() {
        // 2024-06-20T20:51Z and 2024-12-21T09:20Z (Astronomical Almanac).
        for (unix, sign) in [(1_718_916_660.0, 1.0), (1_734_772_800.0, -1.0)] {
            let highest = |latitude: f64| {
                let at = |i: i32| {
                    sun_position(
                        unix,
                        latitude,
                        radians(f64::from(i)),
                        Air { pressure: 0.0, temperature: 10.0 },
                    )
                };
                (0..360).map(|i| at(i).elevation.to_degrees()).fold(-90.0, f64::max)
            };
            // Whole degrees of longitude: within half a degree of culmination, whose height is flat to 0.005° there.
            assert!((highest(radians(40.0)) - (50.0 + sign * 23.44)).abs() < 0.01);
            assert!((highest(radians(90.0)) - sign * 23.44).abs() < 0.01);
        }
    }
}
