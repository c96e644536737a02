use std::sync::Arc;

use onelight::{Films, Look, Process, Reference, stock};

use crate::error::Result;

/// A look to measure: its description, and its films where it names data sheets of one's own.
#[derive(Debug, Clone)]
pub struct DescribedLook {
    /// What is compiled.
    pub process: Process,
    /// The films that the process names, if they are not built in.
    pub films: Option<Arc<Films>>,
}

impl From<Process> for DescribedLook {
    /// A look of built-in films.
    fn from(process: Process) -> Self {
        Self { process, films: None }
    }
}

impl DescribedLook {
    /// The look, whatever its kind.
    ///
    /// # Errors
    /// If it does not compile.
    pub fn look(&self) -> Result<Look> {
        Ok(self.films.as_ref().map_or_else(|| self.process.look(), |films| self.process.look_with(films))?)
    }

    /// The film, which only a film look has.
    pub(crate) fn compile(&self) -> Result<Reference> {
        Ok(self.films.as_ref().map_or_else(|| self.process.compile(), |films| self.process.compile_with(films))?)
    }

    /// The stocks of a film look.
    pub(crate) fn films(&self) -> Result<Arc<Films>> {
        if let Some(films) = &self.films {
            return Ok(Arc::clone(films));
        }
        let camera = stock(self.process.film()?.camera.id())?;
        let print = self.process.print().map(|print| stock(print.id())).transpose()?;
        Ok(Arc::new(Films { camera, print }))
    }
}
