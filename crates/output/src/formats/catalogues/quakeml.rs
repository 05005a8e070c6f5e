//! The catalogue as QuakeML 1.2, basic event description: https://quake.ethz.ch/quakeml.

use super::event::{SourceParameters, Spot};
use super::tensor::{Plane, Tensor};
use crate::decimals::shortest_scientific;
use crate::fields::vtu::admitted;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::io;

type Xml = Writer<Vec<u8>>;

/// Statement that an event is simulated.
const SAID: &str = "Simulated event: no such earthquake has happened.";

/// The document. `id` identifies the run, for example by a hash of the scene.
///
/// # Errors
/// Only errors of the writer to memory.
pub fn quakeml(title: &str, id: &str, events: &[SourceParameters]) -> io::Result<Vec<u8>> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = xml.create_element("q:quakeml").with_attributes([
        ("xmlns", "http://quakeml.org/xmlns/bed/1.2"),
        ("xmlns:q", "http://quakeml.org/xmlns/quakeml/1.2"),
    ]);
    let base = format!("smi:local/asperity/{id}");
    root.write_inner_content(|xml| {
        xml.create_element("eventParameters")
            .with_attribute(("publicID", base.as_str()))
            .write_inner_content(|xml| {
                text(
                    xml,
                    "description",
                    &format!("{title}: simulated by asperity {}", env!("CARGO_PKG_VERSION")),
                )?;
                events
                    .iter()
                    .enumerate()
                    .try_for_each(|(k, located)| event(xml, title, &format!("{base}/{}", k + 1), located))
            })?;
        Ok(())
    })?;
    Ok(xml.into_inner())
}

fn text(xml: &mut Xml, name: &str, value: &str) -> io::Result<()> {
    let value = admitted(value);
    xml.create_element(name).write_text_content(quick_xml::events::BytesText::new(&value))?;
    Ok(())
}

/// A quantity with its value in an element of its own.
fn quantity(xml: &mut Xml, name: &str, value: &str) -> io::Result<()> {
    xml.create_element(name).write_inner_content(|xml| text(xml, "value", value))?;
    Ok(())
}

fn number(xml: &mut Xml, name: &str, value: f64) -> io::Result<()> {
    quantity(xml, name, &shortest_scientific(value))
}

fn event(xml: &mut Xml, title: &str, id: &str, located: &SourceParameters) -> io::Result<()> {
    let (origin_id, focal_id) = (format!("{id}/origin"), format!("{id}/focalMechanism"));
    let element = xml.create_element("event").with_attribute(("publicID", id));
    element.write_inner_content(|xml| {
        text(xml, "preferredOriginID", &origin_id)?;
        if located.magnitude.is_some() {
            text(xml, "preferredMagnitudeID", &format!("{id}/magnitude"))?;
        }
        text(xml, "preferredFocalMechanismID", &focal_id)?;
        text(xml, "type", "other event")?;
        text(xml, "typeCertainty", "known")?;
        xml.create_element("description").write_inner_content(|xml| {
            text(xml, "text", &format!("{title}. {SAID}"))?;
            text(xml, "type", "earthquake name")
        })?;
        if located.moment.is_none() {
            let moment = located.tensor.moment();
            let words = format!("Scalar moment {moment:e} N m per metre of length out of the plane.");
            xml.create_element("comment").write_inner_content(|xml| text(xml, "text", &words))?;
        }
        origin(xml, &origin_id, &located.time, &located.hypocentre)?;
        if let Some(magnitude) = located.magnitude {
            let element = xml.create_element("magnitude");
            let id = format!("{id}/magnitude");
            element.with_attribute(("publicID", id.as_str())).write_inner_content(|xml| {
                number(xml, "mag", magnitude)?;
                text(xml, "type", "Mw")?;
                text(xml, "originID", &origin_id)
            })?;
        }
        mechanism(xml, &focal_id, &origin_id, located)
    })?;
    Ok(())
}

fn origin(xml: &mut Xml, id: &str, time: &str, spot: &Spot) -> io::Result<()> {
    let element = xml.create_element("origin").with_attribute(("publicID", id));
    element.write_inner_content(|xml| {
        quantity(xml, "time", time)?;
        number(xml, "longitude", spot.longitude)?;
        number(xml, "latitude", spot.latitude)?;
        number(xml, "depth", spot.depth)?;
        text(xml, "depthType", "other")?;
        text(xml, "evaluationMode", "automatic")
    })?;
    Ok(())
}

fn mechanism(xml: &mut Xml, id: &str, origin_id: &str, located: &SourceParameters) -> io::Result<()> {
    let element = xml.create_element("focalMechanism").with_attribute(("publicID", id));
    element.write_inner_content(|xml| {
        text(xml, "triggeringOriginID", origin_id)?;
        xml.create_element("nodalPlanes").write_inner_content(|xml| {
            plane(xml, "nodalPlane1", &located.planes[0])?;
            plane(xml, "nodalPlane2", &located.planes[1])
        })?;
        let Some(moment) = located.moment else { return Ok(()) };
        let tensor_id = format!("{id}/momentTensor");
        let element = xml.create_element("momentTensor").with_attribute(("publicID", tensor_id.as_str()));
        element.write_inner_content(|xml| {
            text(xml, "derivedOriginID", origin_id)?;
            number(xml, "scalarMoment", moment)?;
            tensor(xml, &located.tensor)
        })?;
        Ok(())
    })?;
    Ok(())
}

fn plane(xml: &mut Xml, name: &str, plane: &Plane) -> io::Result<()> {
    xml.create_element(name).write_inner_content(|xml| {
        number(xml, "strike", plane.strike)?;
        number(xml, "dip", plane.dip)?;
        number(xml, "rake", plane.rake)
    })?;
    Ok(())
}

fn tensor(xml: &mut Xml, tensor: &Tensor) -> io::Result<()> {
    xml.create_element("tensor").write_inner_content(|xml| {
        let names = ["Mrr", "Mtt", "Mpp", "Mrt", "Mrp", "Mtp"];
        names.iter().zip(tensor.0).try_for_each(|(name, value)| number(xml, name, value))
    })?;
    Ok(())
}
