//! One connection to the controller: version, outputs, start, data.

use std::{
    io::{self, ErrorKind, Write},
    net::{TcpStream, ToSocketAddrs},
    time::Duration,
};

use congruent_input::Diagnostic;

use super::{
    options::RtdeOptions,
    outputs::{OUTPUTS, RobotState},
    package::{DATA, PAUSE, PROTOCOL_VERSION, Package, ReceivedPackages, SETUP_OUTPUTS, START, package},
};
use crate::codes;

/// How long a connection may take, and an answer.
const CONNECTS: Duration = Duration::from_secs(2);
/// How long the socket waits for bytes before it is asked whether to go on.
const PERIOD: Duration = Duration::from_millis(100);
/// Periods without a package after which a connection is lost: a controller gives data at its rate, whatever the arm does.
const MOST_SILENT: u32 = 20;

/// A controller that sends data.
pub(super) struct Connection {
    stream: TcpStream,
    packages: ReceivedPackages,
    recipe: u8,
    silent: u32,
}

impl Connection {
    /// Connects, asks for the outputs and starts.
    ///
    /// # Errors
    /// The controller cannot be reached, or refuses something.
    pub(super) fn open(options: &RtdeOptions) -> Result<Self, Diagnostic> {
        let address = options.with_port();
        Self::try_open(options).map_err(|error| {
            let message = format!("{address}: no data by RTDE: {error}");
            Diagnostic::error(codes::log::RTDE, message).with_help(
                "give the address of the robot, as --rtde 192.168.1.10, and allow RTDE in its settings of network services",
            )
        })
    }

    fn try_open(options: &RtdeOptions) -> io::Result<Self> {
        let mut last = io::Error::new(ErrorKind::NotFound, "the name has no address");
        let mut addresses = options.with_port().to_socket_addrs()?;
        let stream = addresses.find_map(|address| {
            TcpStream::connect_timeout(&address, CONNECTS).map_err(|error| last = error).ok()
        });
        let Some(stream) = stream else { return Err(last) };
        stream.set_read_timeout(Some(PERIOD))?;
        stream.set_write_timeout(Some(CONNECTS))?;
        stream.set_nodelay(true)?;
        let mut opened = Self { stream, packages: ReceivedPackages::default(), recipe: 0, silent: 0 };
        opened.ask(PROTOCOL_VERSION, &2_u16.to_be_bytes())?.accepted("version 2 of the protocol")?;
        let names = OUTPUTS.map(|(name, _)| name).join(",");
        let wanted = [&options.rate_hz.to_be_bytes()[..], names.as_bytes()].concat();
        opened.recipe = opened.ask(SETUP_OUTPUTS, &wanted)?.recipe()?;
        opened.ask(START, &[])?.accepted("the start")?;
        Ok(opened)
    }

    /// Sends a package and waits for its answer; texts of the controller that come between are not used.
    fn ask(&mut self, kind: u8, payload: &[u8]) -> io::Result<Package> {
        self.stream.write_all(&package(kind, payload))?;
        loop {
            let answer = self.next()?;
            if let Some(answer) = answer.filter(|answer| answer.kind == kind) {
                return Ok(answer);
            }
        }
    }

    /// The next package; `None` if none has come for a while.
    fn next(&mut self) -> io::Result<Option<Package>> {
        let next = self.packages.next(&mut self.stream)?;
        self.silent = if next.is_some() { 0 } else { self.silent + 1 };
        if self.silent > MOST_SILENT {
            let silent = PERIOD * MOST_SILENT;
            return Err(io::Error::new(
                ErrorKind::TimedOut,
                format!("nothing came for {} s", silent.as_secs_f64()),
            ));
        }
        Ok(next)
    }

    /// The next state of the robot; `None` if none has come for a while.
    ///
    /// # Errors
    /// The connection is lost.
    pub(super) fn state(&mut self) -> io::Result<Option<RobotState>> {
        let Some(Package { kind: DATA, payload }) = self.next()? else { return Ok(None) };
        if payload.first() != Some(&self.recipe) {
            return Ok(None);
        }
        let state = RobotState::from_payload(&payload);
        state.map(Some).ok_or_else(|| {
            io::Error::new(ErrorKind::InvalidData, "a data package has not the outputs that were asked for")
        })
    }

    /// Asks the controller to send no more.
    pub(super) fn pause(mut self) {
        // There is nothing to be done if it has gone.
        let _ = self.stream.write_all(&package(PAUSE, &[]));
    }
}

impl Package {
    fn accepted(&self, what: &str) -> io::Result<()> {
        if self.payload.first() == Some(&1) {
            return Ok(());
        }
        Err(io::Error::new(ErrorKind::Unsupported, format!("the controller refuses {what}")))
    }

    /// The number of the recipe, if all outputs are there in their types.
    fn recipe(&self) -> io::Result<u8> {
        let refused = |message: String| Err(io::Error::new(ErrorKind::Unsupported, message));
        let Some((&recipe, types)) = self.payload.split_first() else {
            return refused("the controller gives no recipe of outputs".to_owned());
        };
        let types = String::from_utf8_lossy(types);
        let mut found = types.split(',');
        for (name, wanted) in OUTPUTS {
            let found = found.next().unwrap_or("nothing");
            if found != wanted {
                return refused(format!("its output {name} is {found}, expected {wanted}"));
            }
        }
        Ok(recipe)
    }
}
