//! What an independent prototype gives for the 105 real records, with the tables' own digits.
#![allow(clippy::unreadable_literal)]

use crate::golden::Row;

/// A row by PGV and by PGA, with the ordinates at 2, 10 and 50 %; none where the prototype gives none.
pub(crate) struct Expected {
    pub(crate) site: &'static str,
    pub(crate) rows: [Row; 2],
    pub(crate) ordinates_m: [[Option<[f64; 5]>; 3]; 2],
}

/// With the project's curves.
pub(crate) fn project_sites() -> [Expected; 3] {
    [
        Expected {
            site: "Aachen",
            rows: [
                Row {
                    implied: [0.15539, 0.068089, 0.024674],
                    over_site: [0.7068, 0.6173, 0.621],
                    bias_rms_max: [0.6547, 0.4357, 0.573],
                    exponents: [3.5235, 2.3507, 1.6147, 0.8262],
                    effective: [57.75, 34.39, 19.09],
                    least_effective: 20.52,
                    largest_share: 0.1105,
                },
                Row {
                    implied: [27.299, 12.767, 4.1108],
                    over_site: [2.496, 2.545, 2.55],
                    bias_rms_max: [2.52, 0.9244, 0.9399],
                    exponents: [-4.7537, -4.2127, -3.8854, -3.6245],
                    effective: [15.93, 14.47, 12.15],
                    least_effective: 11.71,
                    largest_share: 0.1807,
                },
            ],
            ordinates_m: [
                [
                    Some([0.055578, 0.030289, 0.012646, 0.0017345, 0.00075382]),
                    Some([0.012749, 0.0064324, 0.0026193, 0.00071939, 0.00042196]),
                    None,
                ],
                [
                    Some([0.0552, 0.031108, 0.013121, 0.0016187, 0.00074304]),
                    Some([0.012634, 0.0068015, 0.0026201, 0.00072555, 0.0004359]),
                    None,
                ],
            ],
        },
        Expected {
            site: "Montreux",
            rows: [
                Row {
                    implied: [0.22081, 0.10514, 0.038621],
                    over_site: [0.8651, 0.7628, 0.6702],
                    bias_rms_max: [0.7861, 0.2676, 0.4257],
                    exponents: [1.9069, 1.3381, 0.6737, -0.2473],
                    effective: [93.45, 74.15, 54.0],
                    least_effective: 51.87,
                    largest_share: 0.04782,
                },
                Row {
                    implied: [33.219, 16.675, 6.4002],
                    over_site: [2.193, 2.21, 2.246],
                    bias_rms_max: [2.2, 0.7884, 0.816],
                    exponents: [-3.6064, -3.2427, -3.1072, -2.9403],
                    effective: [23.42, 21.91, 19.04],
                    least_effective: 18.64,
                    largest_share: 0.1253,
                },
            ],
            ordinates_m: [
                [Some([0.086042, 0.059932, 0.023383, 0.0027011, 0.00078073]), None, None],
                [Some([0.08411, 0.06306, 0.022812, 0.0031457, 0.00078709]), None, None],
            ],
        },
        Expected {
            site: "Athens",
            rows: [
                Row {
                    implied: [0.54841, 0.25173, 0.094397],
                    over_site: [1.053, 0.8967, 0.7648],
                    bias_rms_max: [0.9359, 0.1668, 0.3105],
                    exponents: [1.4663, 0.5018, -0.2392, -1.3706],
                    effective: [99.67, 97.8, 74.57],
                    least_effective: 71.09,
                    largest_share: 0.02991,
                },
                Row {
                    implied: [66.888, 35.108, 14.362],
                    over_site: [1.73, 1.954, 2.073],
                    bias_rms_max: [1.877, 0.6344, 0.7473],
                    exponents: [-3.1402, -2.6758, -2.0958, -1.4456],
                    effective: [40.93, 32.11, 24.33],
                    least_effective: 23.73,
                    largest_share: 0.1032,
                },
            ],
            ordinates_m: [
                [
                    Some([0.37843, 0.23652, 0.17121, 0.059421, 0.0020501]),
                    Some([0.10257, 0.077489, 0.030482, 0.0036202, 0.00078073]),
                    Some([0.024296, 0.011018, 0.0033187, 0.00071939, 0.00037339]),
                ],
                [
                    Some([0.37052, 0.23721, 0.17585, 0.055629, 0.0021812]),
                    Some([0.10082, 0.080944, 0.031432, 0.0039372, 0.00078709]),
                    Some([0.024072, 0.011343, 0.0033454, 0.00075304, 0.00042912]),
                ],
            ],
        },
    ]
}

/// With curves of the original source zones.
pub(crate) fn original_zones() -> [Expected; 2] {
    [
        Expected {
            site: "Montreux",
            rows: [
                Row {
                    implied: [0.20973, 0.0988, 0.036505],
                    over_site: [0.8364, 0.736, 0.6568],
                    bias_rms_max: [0.7715, 0.2833, 0.4222],
                    exponents: [2.1268, 1.4608, 0.7527, -0.1714],
                    effective: [91.14, 68.67, 45.92],
                    least_effective: 45.92,
                    largest_share: 0.0539,
                },
                Row {
                    implied: [32.318, 16.046, 6.1636],
                    over_site: [2.211, 2.242, 2.302],
                    bias_rms_max: [2.245, 0.809, 0.8436],
                    exponents: [-3.7130, -3.4066, -3.1505, -2.9530],
                    effective: [22.77, 20.51, 17.87],
                    least_effective: 17.56,
                    largest_share: 0.1311,
                },
            ],
            ordinates_m: [
                [Some([0.081864, 0.054517, 0.021818, 0.0024117, 0.00078073]), None, None],
                [Some([0.080686, 0.05746, 0.021766, 0.0025885, 0.00078709]), None, None],
            ],
        },
        Expected {
            site: "Athens",
            rows: [
                Row {
                    implied: [0.5317, 0.25533, 0.099964],
                    over_site: [1.08, 0.9286, 0.8103],
                    bias_rms_max: [0.9784, 0.1468, 0.2437],
                    exponents: [1.0872, 0.4121, -0.3761, -1.6973],
                    effective: [98.95, 100.3, 86.61],
                    least_effective: 83.45,
                    largest_share: 0.02338,
                },
                Row {
                    implied: [65.015, 34.308, 14.368],
                    over_site: [1.762, 1.904, 1.964],
                    bias_rms_max: [1.848, 0.6166, 0.6839],
                    exponents: [-2.8045, -2.6151, -2.1369, -1.4493],
                    effective: [41.29, 33.43, 28.54],
                    least_effective: 28.23,
                    largest_share: 0.08885,
                },
            ],
            ordinates_m: [
                [
                    Some([0.37771, 0.23011, 0.16165, 0.053185, 0.0020253]),
                    Some([0.10459, 0.078447, 0.030221, 0.0033849, 0.00075382]),
                    Some([0.026737, 0.011962, 0.0033187, 0.00071939, 0.000371]),
                ],
                [
                    Some([0.36604, 0.22848, 0.16451, 0.046425, 0.002063]),
                    Some([0.10242, 0.081871, 0.030892, 0.0037188, 0.00077028]),
                    Some([0.026981, 0.012225, 0.003338, 0.00073067, 0.00039958]),
                ],
            ],
        },
    ]
}
