//! `stargrip-cam new NAME --object Q --mass Q`: the spec of a gripper that holds an object.

use std::path::Path;

use crate::answer::new_gripper::NearRequest;
use crate::answer::object;
use crate::answer::object::{FORCES, FRICTIONS, MASSES, NoGripper, PRESSURES, Request, sheet};
use crate::answer::quantity::{SIZE, number, stated};
use crate::cli::defaults;
use crate::cli::escape::argument;
use crate::cli::failure::Failure;
use crate::cli::material::FabricArg;
use crate::cli::source_file::read_source;
use crate::cli::words::words;
use forecast::sizing::Requirements;
use spec::units::{Force, Length, Mass, Pressure, Readable, Stated};
use spec::{Machine, ObjectShape, Source, Spec};

pub(super) use crate::answer::new_gripper::NewGripper;

/// All of [`ObjectArgs`], which a drawing excludes.
pub(super) const OBJECT_OPTIONS: [&str; 9] =
    ["object", "height", "shape", "mass", "pressure", "friction", "fragile", "machine", "sheet"];

/// Arguments about the object.
#[derive(clap::Args, Debug)]
pub(super) struct ObjectArgs {
    /// Width of the object where it is gripped: "70 mm"; needs --mass.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = stated::<Length>(SIZE), requires = "mass")]
    object: Option<Stated<Length>>,
    /// Height of the object along the gripper's axis: "57 mm"; default: as tall as wide.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = stated::<Length>(SIZE), requires = "object")]
    height: Option<Stated<Length>>,
    /// Shape of the object; default: ball.
    #[arg(long, value_name = "SHAPE", value_parser = words(&ObjectShape::ALL, &[]), requires = "object")]
    shape: Option<ObjectShape>,
    /// Mass of the object: "1.3 kg"; required with --object.
    #[arg(long, value_name = "MASS", allow_hyphen_values = true, value_parser = stated::<Mass>(MASSES), requires = "object")]
    mass: Option<Stated<Mass>>,
    /// The pressure that your pump gives; default: the best from 5 to 60 kPa.
    #[arg(long, value_name = "PRESSURE", allow_hyphen_values = true, value_parser = stated::<Pressure>(PRESSURES), requires = "object")]
    pressure: Option<Stated<Pressure>>,
    /// Friction between corners and object; default: 0.3, bare fabric on a smooth surface. Coated corners have about 1.
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, value_parser = number(FRICTIONS), requires = "object")]
    friction: Option<f64>,
    /// Largest radial force of one star that the object bears: "20 N".
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true, value_parser = stated::<Force>(FORCES), requires = "object")]
    fragile: Option<Stated<Force>>,
    /// A built-in machine profile's name, or a file with your own; default: generic.
    #[arg(long, value_name = "NAME", requires = "object")]
    machine: Option<String>,
    /// Size of the fabric sheets: 400x400 in mm, or A4.
    #[arg(long, value_name = "WxH", value_parser = sheet, requires = "object")]
    sheet: Option<[Length; 2]>,
}

/// The spec of a gripper for the object; `None` without an object.
pub(super) fn spec_for_object(
    name: &str,
    args: &ObjectArgs,
    fabric: &FabricArg,
) -> Result<Option<NewGripper>, Failure> {
    let Some((object, mass)) = args.object.zip(args.mass) else { return Ok(None) };
    let base_spec = base(args, fabric)?;
    let base_machine = machine(&base_spec.machine.profile)?;
    let ObjectArgs { height, shape, pressure, friction, fragile, .. } = *args;
    let request = Request { object, height, shape, mass, pressure, friction, fragile };
    request.gripper(name, &base_spec, &base_machine).map(Some).map_err(|why| match why {
        NoGripper::Fault(text) => Failure::Message(text),
        NoGripper::Infeasible(reasons, near) => {
            let required = request.requirements(&base_spec, &base_machine);
            let nearest = near.iter().map(|near| in_words(name, args, fabric, &required, near)).collect();
            let line = |reason: &String| format!("\n  {reason}");
            let reasons: String = reasons.iter().map(line).collect();
            Failure::Infeasible(format!("no gripper was found that does all of this:{reasons}"), nearest)
        }
    })
}

/// A request that was found in place of the one with the requirements `required`: its offer, its gripper, and its command.
fn in_words(
    name: &str,
    args: &ObjectArgs,
    fabric: &FabricArg,
    required: &Requirements,
    nearest: &NearRequest,
) -> String {
    // The command has every option of the request with the eased values, so that it can be run as it is; the others are the
    // user's own.
    let eased = &nearest.requirements;
    let friction = (!eased.friction_assumed).then_some(eased.friction);
    let sheet = if eased.room.sheet == required.room.sheet { args.sheet } else { Some(eased.room.sheet) };
    let sheet = sheet.filter(|sides| sides.iter().all(|side| side.0.is_finite()));
    let options = [
        ("object", Some(eased.width_in_words())),
        ("height", eased.height_in_words()),
        ("shape", eased.shape.map(|shape| shape.word().to_owned())),
        ("mass", Some(eased.mass_in_words())),
        ("pressure", eased.pressure_in_words()),
        ("friction", friction.map(|friction| Readable(friction).to_string())),
        ("fragile", eased.force_in_words()),
        ("fabric", fabric.fabric.clone()),
        ("machine", args.machine.clone()),
        ("sheet", sheet.map(|[width, height]| format!("{}x{}", width.0, height.0))),
    ];
    let word = |(option, value): (&str, Option<String>)| Some(format!(" --{option} {}", argument(value?)));
    let gripper = &nearest.gripper;
    let command = format!(
        "stargrip-cam new {}{}",
        argument(name),
        options.into_iter().filter_map(word).collect::<String>()
    );
    let lines = [Some(nearest.offer()), gripper.doubt_in_words(), gripper.star_in_words(), Some(command)];
    lines.into_iter().flatten().collect::<Vec<_>>().join("\n  ")
}

/// The base of the search: fabric, machine, sheet and radii of curvature.
fn base(args: &ObjectArgs, fabric: &FabricArg) -> Result<Spec, Failure> {
    let text = spec::starter("base").map_err(Failure::Message)?;
    let source = Source::new("starter", defaults::written_into(text)?);
    let text = fabric.written_into(source, true)?.text;
    Ok(object::base(text, args.machine.as_deref(), args.sheet)?)
}

/// The machine of a built-in profile, or of a file.
pub(super) fn machine(profile: &str) -> Result<Machine, Failure> {
    if spec::builtin_machine(profile).is_some() {
        return Machine::builtin(profile).map_err(Failure::Message);
    }
    let path = Path::new(profile);
    if path.is_file() {
        return Ok(spec::read_machine(&read_source(path)?)?);
    }
    let names = || format!("there are {}", spec::builtin_machines().collect::<Vec<_>>().join(", "));
    let remedy = match spec::usual_profile(profile) {
        Some((controller, name)) => format!("it usually has {controller}: --machine {name}"),
        None => spec::machine_remedy(profile).unwrap_or_else(names),
    };
    Err(Failure::Message(format!("{profile:?} is not a machine profile, and not a file; {remedy}")))
}
