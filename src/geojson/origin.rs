//! Where the plane lies on the earth: x to the east and y to the north of a point, as the azimuthal equidistant
//! projection of WGS 84 has it (`+proj=aeqd`): distance and direction from that point are exact.

use std::str::FromStr;

use geographiclib_rs::{DirectGeodesic, Geodesic};

/// Positions farther than this from the origin, in metres, are not in any field: units must be wrong.
const REACH_M: f64 = 1e6;

/// The point on the earth at which the plane's origin lies; the plane's y points north there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    lon_deg: f64,
    lat_deg: f64,
}

impl Origin {
    /// Longitude and latitude in degrees of a position in metres; none more than 1,000 km away.
    pub(super) fn locate(&self, [x_m, y_m]: [f64; 2]) -> Option<[f64; 2]> {
        let distance_m = x_m.hypot(y_m);
        if distance_m.is_nan() || distance_m > REACH_M {
            return None;
        }
        let azimuth_deg = x_m.atan2(y_m).to_degrees();
        let (lat, lon): (f64, f64) =
            Geodesic::wgs84().direct(self.lat_deg, self.lon_deg, azimuth_deg, distance_m);
        Some([lon, lat])
    }
}

impl FromStr for Origin {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let broken = || {
            let start: String = text.chars().take(80).collect();
            format!(
                "{start:?} must be LON,LAT in degrees, from -180 to 180 and from -90 to 90, such as 11.58,48.14"
            )
        };
        let (lon, lat) = text.split_once(',').ok_or_else(broken)?;
        let number = |text: &str, most: f64| {
            text.parse().ok().filter(|n: &f64| n.abs() <= most).ok_or_else(broken)
        };
        Ok(Self { lon_deg: number(lon, 180.0)?, lat_deg: number(lat, 90.0)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_degree_of_latitude_is_as_long_as_geodesy_says() {
        let origin: Origin = "11.5,45".parse().unwrap();
        assert_eq!(origin.locate([0.0, 0.0]), Some([11.5, 45.0]));
        // From 45 to 46 degrees: 111,141.5 m on WGS 84.
        let [lon, lat] = origin.locate([0.0, 111_141.5]).unwrap();
        assert!((lon - 11.5).abs() < 1e-9 && (lat - 46.0).abs() < 1e-5, "{lon} {lat}");
        // A degree of longitude at 45 degrees is 78,846.8 m; the great circle bends north of the parallel.
        let [lon, lat] = origin.locate([7_884.68, 0.0]).unwrap();
        assert!((lon - 11.6).abs() < 1e-5 && (lat - 45.0).abs() < 1e-4, "{lon} {lat}");
    }

    #[test]
    fn west_and_south_are_negative_and_nothing_is_a_world_away() {
        let origin: Origin = "0,0".parse().unwrap();
        let [lon, lat] = origin.locate([-1_000.0, -1_000.0]).unwrap();
        assert!(lon < 0.0 && lat < 0.0);
        assert_eq!(origin.locate([1e6, 1.0]), None);
        assert_eq!(origin.locate([f64::NAN, 1.0]), None);
    }

    #[test]
    fn what_is_no_origin_is_refused() {
        for text in ["", "1", "1,2,3", "181,0", "0,91", "east,north", "NaN,0", "inf,0"] {
            assert!(text.parse::<Origin>().unwrap_err().contains("LON,LAT"), "{text}");
        }
    }
}
