//! A fragility model of `OpenQuake`, NRML 0.5: discrete functions of counted shares, continuous ones of lognormal fits.

use crate::function::without_fit;
use crate::{FragilityFunction, FragilityState};

/// The model as a document, and what it leaves out; `line` says where the numbers come from.
///
/// All functions of a model have the same limit states: those that all systems have. A system with a fit of each has a
/// second function, `…_lognormal`.
pub fn nrml_model(functions: &[FragilityFunction], line: &str) -> (String, Vec<String>) {
    let mut notes = Vec::new();
    let names = common_states(functions, &mut notes);
    let mut lines = Vec::new();
    for FragilityFunction { id, imt, levels, states } in functions {
        let states: Vec<&FragilityState> = states.iter().filter(|own| names.contains(&&*own.name)).collect();
        lines.push(format!("    <fragilityFunction id=\"{id}\" format=\"discrete\">"));
        lines.push(format!("      <imls imt=\"{imt}\">{}</imls>", numbers(levels)));
        let poes =
            |state: &&FragilityState| format!("      <poes ls=\"{}\">{}</poes>", state.name, numbers(&state.shares));
        lines.extend(states.iter().map(poes));
        lines.push("    </fragilityFunction>".to_owned());
        let missing: Vec<&str> = states.iter().filter(|own| moments(own).is_none()).map(|own| &*own.name).collect();
        if let Some(note) = without_fit(id, &missing) {
            notes.push(note);
            continue;
        }
        let (first, last) = (levels.first().copied().unwrap_or(0.0), levels.last().copied().unwrap_or(0.0));
        let attributes = "format=\"continuous\" shape=\"logncdf\"";
        lines.push(format!("    <fragilityFunction id=\"{id}_lognormal\" {attributes}>"));
        lines.push(format!("      <imls imt=\"{imt}\" minIML=\"{first}\" maxIML=\"{last}\"/>"));
        let parameters = |state: &&FragilityState| {
            let [mean, deviation] = moments(state)?;
            Some(format!("      <params ls=\"{}\" mean=\"{mean}\" stddev=\"{deviation}\"/>", state.name))
        };
        lines.extend(states.iter().filter_map(parameters));
        lines.push("    </fragilityFunction>".to_owned());
    }
    let text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  \
         <fragilityModel id=\"uplift\" assetCategory=\"structures\" lossCategory=\"structural\">\n    \
         <description>{}</description>\n    \
         <limitStates>{}</limitStates>\n{}\n  </fragilityModel>\n</nrml>\n",
        escaped(line),
        names.join(" "),
        lines.join("\n")
    );
    (text, notes)
}

/// The limit states that all systems have; `notes` gets the others.
fn common_states<'a>(functions: &'a [FragilityFunction], notes: &mut Vec<String>) -> Vec<&'a str> {
    let has = |of: &FragilityFunction, name: &str| of.states.iter().any(|state| state.name == name);
    let mut all: Vec<&str> = Vec::new();
    for state in functions.iter().flat_map(|of| &of.states) {
        if !all.contains(&&*state.name) {
            all.push(&state.name);
        }
    }
    let (common, others): (Vec<&str>, Vec<&str>) =
        all.into_iter().partition(|name| functions.iter().all(|of| has(of, name)));
    for name in others {
        let without: Vec<&str> = functions.iter().filter(|of| !has(of, name)).map(|of| of.id.as_str()).collect();
        notes.push(format!("limit state {name} is left out: {} has none", without.join(", ")));
    }
    common
}

/// Mean and standard deviation of the intensity of a lognormal function, as `OpenQuake` takes them; none where there is
/// no fit, or its dispersion is beyond all numbers.
fn moments(state: &FragilityState) -> Option<[f64; 2]> {
    let fragility = state.lognormal?;
    let variance = fragility.dispersion().powi(2);
    let mean = fragility.median() * (0.5 * variance).exp();
    let deviation = mean * variance.exp_m1().sqrt();
    deviation.is_finite().then_some([mean, deviation])
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

/// `text` between tags.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
